//! Pixels with comparable velocity and depth: well inside objects that both pictures show there.

use std::ops::RangeInclusive;

use frame::Raster;
use tracer::PointLayers;

/// Smallest number of pixels of an object that is judged.
pub const MIN_PIXELS: usize = 9;

/// Comparable pixels of one object.
pub struct ClearPixels {
    /// Number of the object, 0 for the background.
    pub object: u32,
    /// Indices in the raster.
    pub pixels: Vec<usize>,
}

/// Selects the objects with enough pixels to judge them.
pub fn select_judged(regions: &[ClearPixels]) -> Vec<&ClearPixels> {
    let is_judged = |region: &&ClearPixels| region.pixels.len() >= MIN_PIXELS;
    regions.iter().filter(is_judged).collect()
}

/// Selects each object's pixels with eight neighbours of the same object, if the engine shows the
/// same there.
pub fn select_clear_pixels(
    right: &PointLayers,
    objects: usize,
    is_same: &dyn Fn(usize) -> bool,
) -> Vec<ClearPixels> {
    let ids = &right.object_id;
    (0..objects as u32)
        .map(|object| ClearPixels {
            object,
            pixels: (0..ids.pixels.len())
                .filter(|at| ids.pixels[*at] == object && is_same(*at) && is_inside(ids, *at))
                .collect(),
        })
        .collect()
}

/// Returns whether a pixel and its neighbours show the same object.
pub fn is_inside(ids: &Raster<u32>, at: usize) -> bool {
    neighbours(ids, at).all(|place| ids.pixels[place] == ids.pixels[at])
}

/// Lists a pixel and its neighbours.
pub fn neighbours<T>(raster: &Raster<T>, at: usize) -> impl Iterator<Item = usize> {
    let (width, height) = (raster.width as usize, raster.height as usize);
    let around = |place: usize, end: usize| -> RangeInclusive<usize> {
        place.saturating_sub(1)..=(place + 1).min(end - 1)
    };
    let columns = around(at % width, width);
    around(at / width, height)
        .flat_map(move |row| columns.clone().map(move |column| row * width + column))
}
