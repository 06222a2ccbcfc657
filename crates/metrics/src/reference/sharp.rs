//! The sharp picture of the shutter's middle, which has skill 0.

use frame::{Accumulation, Picture};

/// The sharp picture of the shutter's middle.
#[derive(Clone, Debug)]
pub enum Sharp {
    /// The frame, whose instant is the middle.
    Frame(Picture),
    /// The accumulation of one sub-frame.
    Accumulation(Accumulation),
}

impl Sharp {
    /// Leaves a group of samples out of an accumulation; a frame stays as it is.
    pub fn without(&self, group: usize) -> Self {
        match self {
            Self::Frame(picture) => Self::Frame(picture.clone()),
            Self::Accumulation(rung) => Self::Accumulation(rung.without(group)),
        }
    }
}
