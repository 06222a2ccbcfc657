//! Dilation of masks by a square.

use frame::Raster;

/// Marks every pixel within `margin` columns and rows of a marked one. The square contains the disc
/// of that radius.
pub(crate) fn dilate_square(mask: &Raster<bool>, margin: u32) -> Raster<bool> {
    let within = |at: u32, end: u32| at.saturating_sub(margin)..(at + margin + 1).min(end);
    let across = Raster::from_fn(mask.width, mask.height, |x, y| {
        within(x, mask.width).any(|x| *mask.at(x, y))
    });
    Raster::from_fn(mask.width, mask.height, |x, y| {
        within(y, mask.height).any(|y| *across.at(x, y))
    })
}
