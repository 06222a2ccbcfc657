//! Objectives of a tuning.

/// A score that trials are judged by, apart from the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// `flip_moving`; always measured.
    Flip,
    /// `bleed_lateral` of the worst scene.
    Bleed,
    /// GPU time.
    Cost,
}

impl Objective {
    /// Every objective.
    pub const ALL: [Objective; 3] = [Self::Flip, Self::Bleed, Self::Cost];

    /// Returns the word for it in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flip => "flip",
            Self::Bleed => "bleed",
            Self::Cost => "cost",
        }
    }
}
