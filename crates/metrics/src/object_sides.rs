//! Where an object's bleed belongs.

use frame::{Frame, Picture, Raster};

use crate::bleed::{Side, sides};
use crate::mover::Mover;

/// On which side of what the truth shows of object `id` each pixel lies, as its bleed is told apart; none for an object that
/// is not seen at the instant, does not move, or never shows. `frame` has no guard band, `mean` is the truth's.
pub fn object_sides(frame: &Frame, mean: &Picture, id: u32) -> Option<Raster<Side>> {
    let mover = Mover::new(frame, id).ok()?;
    sides(&mean.coverage[id as usize], &mover.directions)
}
