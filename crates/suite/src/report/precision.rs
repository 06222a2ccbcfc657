//! How many bits of a number a page keeps.

use half::f16;

/// What stands behind a number in a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// The float of the OpenEXR file, bit for bit.
    Float,
    /// The nearest half: three digits that count. What lies in [0, 1] by its nature is kept in steps of 1/256.
    Half,
}

/// What a plane's numbers are, as far as their digits go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// Any number: radiance, motion, depth.
    Number,
    /// Between 0 and 1, for looking at: an error, a share.
    Share,
}

impl Precision {
    /// Bytes per number.
    pub fn width(self) -> usize {
        match self {
            Precision::Float => 4,
            Precision::Half => 2,
        }
    }

    /// The word that the script reads.
    pub fn name(self) -> &'static str {
        match self {
            Precision::Float => "float",
            Precision::Half => "half",
        }
    }

    /// The bits of a number; a half's are the lower 16.
    pub fn bits(self, value: f32, nature: Nature) -> u32 {
        match (self, nature) {
            (Precision::Float, _) => value.to_bits(),
            (Precision::Half, Nature::Number) => u32::from(f16::from_f32(value).to_bits()),
            (Precision::Half, Nature::Share) => {
                let stepped = (value * 256.0).round() / 256.0;
                u32::from(f16::from_f32(stepped).to_bits())
            }
        }
    }
}
