//! Precision of the numbers on a page.

use half::f16;

/// What stands behind a number in a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// The float of the OpenEXR file, bit for bit.
    Float,
    /// The nearest half: three digits that count. What lies in [0, 1] by its nature is kept in steps of 1/256.
    Half,
    /// Seven bits of a number, as the upper 12 of a half: finer than the steps of a screen. What lies in [0, 1] has steps of
    /// 1/64.
    Screen,
}

/// How many bits of a half [`Precision::Screen`] drops.
const DROPPED: u32 = 4;

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
            Precision::Half | Precision::Screen => 2,
        }
    }

    /// The word that the script reads.
    pub fn name(self) -> &'static str {
        match self {
            Precision::Float => "float",
            Precision::Half => "half",
            Precision::Screen => "screen",
        }
    }

    /// The bits of a number; a half's are the lower 16.
    pub fn bits(self, value: f32, nature: Nature) -> u32 {
        match (self, nature) {
            (Precision::Float, _) => value.to_bits(),
            (Precision::Half, Nature::Number) => half(value),
            (Precision::Half, Nature::Share) => half((value * 256.0).round() / 256.0),
            (Precision::Screen, Nature::Number) => shortened(half(value)),
            (Precision::Screen, Nature::Share) => shortened(half((value * 64.0).round() / 64.0)),
        }
    }
}

fn half(value: f32) -> u32 {
    u32::from(f16::from_f32(value).to_bits())
}

/// The upper bits of a half, rounded; the largest halves are cut, for rounded they would be infinite.
fn shortened(half: u32) -> u32 {
    let up = half + (1 << (DROPPED - 1));
    let carries_over = up & INFINITE == INFINITE && half & INFINITE != INFINITE;
    let rounded = if carries_over || half & INFINITE == INFINITE {
        half
    } else {
        up
    };
    rounded >> DROPPED
}

/// All bits of a half's exponent.
const INFINITE: u32 = 0x7c00;

#[cfg(test)]
mod tests {
    use super::*;

    /// As the page's script reads it.
    fn shown(value: f32, nature: Nature) -> f32 {
        let bits = Precision::Screen.bits(value, nature) << DROPPED;
        f16::from_bits(bits as u16).to_f32()
    }

    #[test]
    fn what_a_screen_shows_is_right_to_a_part_in_128() {
        for value in [1e-4, 0.013, 0.5, 0.999, 1.0, 3.7, -250.0, 65_000.0] {
            let shown = shown(value, Nature::Number);
            assert!(
                (shown - value).abs() <= value.abs() / 128.0,
                "{value}: {shown}"
            );
        }
        for value in [0.0, 0.01, 0.33, 0.7, 1.0] {
            let shown = shown(value, Nature::Share);
            // Half a step of 1/64, and a part in 128.
            assert!((shown - value).abs() <= 1.0 / 64.0, "{value}: {shown}");
        }
        assert_eq!(shown(0.0, Nature::Number), 0.0);
        assert_eq!(shown(f32::INFINITY, Nature::Number), f32::INFINITY);
        assert!(shown(f32::NAN, Nature::Number).is_nan());
        // The largest half, whose neighbour above would be infinite.
        assert_eq!(shown(65_504.0, Nature::Number), 65_024.0);
    }
}
