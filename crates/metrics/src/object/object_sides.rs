//! Side of an object's motion that each pixel lies on.

use frame::{Frame, Raster, Support};

use crate::object::bleed::{Side, sides};
use crate::object::mover::Mover;

/// On which side of where object `id` is seen each pixel lies, as its bleed is told apart; none for an object that is not
/// seen at the instant, does not move, or never shows. `frame` has no guard band, `support` is the truth's.
pub fn object_sides(frame: &Frame, support: &Support, id: u32) -> Option<Raster<Side>> {
    let mover = Mover::new(frame, id).ok()?;
    sides(&support.seen[id as usize], &mover.directions)
}
