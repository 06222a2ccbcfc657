//! Lateral bleed alone, for searches that need no other score of mattes.

use frame::Plane;

use crate::{Measured, Reference};

impl Reference<'_> {
    /// Measures `bleed_lateral` of a picture's mattes (one per object of the truth, the background
    /// first), as [`Reference::measure`] does; `None` if it applies to no object.
    pub fn measure_bleed_lateral(&self, coverage: &[Plane]) -> Option<f64> {
        let objects = self.objects.iter().zip(&coverage[1..]);
        let bleeds =
            objects.filter_map(|(object, matte)| match object.score_bleed(matte).lateral {
                Measured::Score(score) => Some(score.value),
                Measured::NotApplicable { .. } => None,
            });
        bleeds.max_by(f64::total_cmp)
    }
}
