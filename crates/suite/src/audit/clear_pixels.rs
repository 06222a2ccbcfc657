//! Pixels whose velocity and depth can be compared: well inside of objects that both pictures show there.

use frame::{Plane, Raster};
use tracer::PointLayers;

use super::depth_audit::is_close_depth;

/// Part of the pixels whose depth must agree before depth tells what the engine shows there.
const LEAST_AGREEING: f64 = 0.7;

/// Pixels of one object that can be compared.
pub struct ClearPixels {
    /// Number of the object, 0 for the background.
    pub object: u32,
    /// Places in the raster.
    pub pixels: Vec<usize>,
}

/// Selects per object the pixels whose eight neighbours show the same object. Leaves out those where the engine's ids name another
/// object; without ids, those where its depth differs, unless that differs nearly everywhere.
pub fn select_clear_pixels(
    right: &PointLayers,
    ids: Option<&Raster<u32>>,
    depth: &Plane,
    objects: usize,
) -> Vec<ClearPixels> {
    let own = &right.object_id;
    let same_depth: Vec<bool> = (depth.pixels.iter().zip(&right.depth.pixels))
        .map(|(found, expected)| is_close_depth(*found, *expected))
        .collect();
    let agreeing = same_depth.iter().filter(|is_same| **is_same).count();
    let depth_tells = agreeing as f64 >= LEAST_AGREEING * same_depth.len() as f64;
    let is_same = |at: usize| match ids {
        Some(ids) => ids.pixels[at] == own.pixels[at],
        None => !depth_tells || same_depth[at],
    };
    (0..objects as u32)
        .map(|object| ClearPixels {
            object,
            pixels: (0..own.pixels.len())
                .filter(|at| own.pixels[*at] == object && is_same(*at) && is_inside(own, *at))
                .collect(),
        })
        .collect()
}

/// Tells whether a pixel and its neighbours show the same object.
fn is_inside(ids: &Raster<u32>, at: usize) -> bool {
    let (width, height) = (ids.width as usize, ids.height as usize);
    let (x, y) = (at % width, at / width);
    let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
    columns.into_iter().all(|column| {
        (y.saturating_sub(1)..=(y + 1).min(height - 1))
            .all(|row| ids.pixels[row * width + column] == ids.pixels[at])
    })
}
