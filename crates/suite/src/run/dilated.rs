//! Dilated velocity map of a filter, for looking at.

use filters::{Filter, FilterError, Holds};
use frame::{Frame, Raster, Vectors};

use crate::Runner;

/// The velocity at the place that each pixel was given in the runner's last run, without the frame's guard band; none for
/// filters without such places.
pub(crate) fn dilated(
    filter: &Filter,
    runner: &Runner,
    frame: &Frame,
) -> Result<Option<Vectors>, FilterError> {
    let mut textures = filter.textures.iter();
    let places = textures.find(|texture| texture.holds == Some(Holds::Places));
    let (Some(places), Runner::Kernels(blur)) = (places, runner) else {
        return Ok(None);
    };
    let places = blur.read_texture(&places.name)?;
    Ok(Some(
        velocities_at(&places, frame).cropped(frame.guard_band),
    ))
}

/// Of the pixels that hold the places, which border pixels stand for beyond the frame.
fn velocities_at(places: &Raster<[f32; 4]>, frame: &Frame) -> Vectors {
    let (width, height) = frame.size();
    places.map(|[x, y, ..]| {
        let [column, row] =
            [(x, width), (y, height)].map(|(at, size)| (at.floor().max(0.0) as u32).min(size - 1));
        *frame.velocity.at(column, row)
    })
}
