//! Objectives of a tuning.

use suite::named;

named! {
    /// A score that trials are judged by, apart from the others.
    pub enum Objective {
        /// `flip_moving`; always measured.
        Flip = "flip",
        /// `bleed_lateral` of the worst scene.
        Bleed = "bleed",
        /// GPU time.
        Cost = "cost",
    }
}
