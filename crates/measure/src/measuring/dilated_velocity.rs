//! Dilated velocity of a filter, for inspection.

use filters::{Filter, FilterError, Holds};
use frame::{Frame, Raster, Size, Vectors};

use crate::runner::Runner;

/// Reads the velocity that the runner's last run gave to each pixel, without the guard band; none
/// for filters that do not record where pixels take their velocity.
pub(crate) fn read_dilated_velocity(
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

/// Looks up the velocity at each place; places beyond the frame use border pixels.
fn velocities_at(places: &Raster<[f32; 4]>, frame: &Frame) -> Vectors {
    let Size { width, height } = frame.size();
    places.map(|[x, y, ..]| {
        let [column, row] =
            [(x, width), (y, height)].map(|(at, size)| (at.floor().max(0.0) as u32).min(size - 1));
        *frame.velocity.at(column, row)
    })
}
