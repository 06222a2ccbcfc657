//! Formats of the velocity buffer.

use frame::{Frame, Size, Vectors};
use half::f16;

use super::depth_format::unorm;
use crate::named;

/// Tile, and longest half-velocity, of McGuire et al. 2012, in pixels.
const TILE: f64 = 20.0;
/// Longest half-velocity of KinoMotion, as a part of the picture's height.
const KINO_RADIUS: f64 = 0.05;

named! {
    /// Format of the velocity buffer.
    pub enum VelocityFormat {
        /// 32-bit floats of pixels.
        Float32 = "float32",
        /// 16-bit floats of pixels.
        Float16 = "float16",
        /// Twice 8 bits, linear: 0.5 + 0.5 x, where 1 is the whole way from the centre to the
        /// border. Standing still is none of the values.
        Linear8 = "linear8",
        /// Three times 8 bits: the unit direction, linear, and the square root of the length, where
        /// 1 is the way from the centre to the border.
        PolarSqrt8 = "polar_sqrt8",
        /// Twice 10 bits of half the smear, linear up to a twentieth of the picture's height, as
        /// KinoMotion packs it.
        Kino10 = "kino10",
        /// Half the smear, no longer than a tile of 20 pixels and no shorter than half a pixel
        /// (McGuire et al. 2012).
        TileClamped = "tile_clamped",
    }
}

/// Rounds a velocity as the buffer stores it, in units of the format.
type Store = fn([f64; 2]) -> [f64; 2];

impl VelocityFormat {
    /// Returns a velocity of the frame as read from this buffer.
    pub(crate) fn apply(self, frame: &Frame, velocity: &Vectors) -> Vectors {
        let Size { width, height } = frame.size();
        let [width, height] = [width, height].map(|side| f64::from(side - 2 * frame.guard_band));
        let to_border = [0.5 * width, 0.5 * height];
        let half_smear = 0.5 * frame.exposure;
        let (unit, store): ([f64; 2], Store) = match self {
            Self::Float32 => return velocity.clone(),
            Self::Float16 => {
                let store = |part| f16::from_f32(part).to_f32();
                return velocity.map(|velocity| velocity.map(store));
            }
            Self::Linear8 => (to_border, linear8),
            Self::PolarSqrt8 => (to_border, polar_sqrt8),
            Self::Kino10 => ([KINO_RADIUS * height / half_smear; 2], kino10),
            Self::TileClamped => ([1.0 / half_smear; 2], tile_clamped),
        };
        velocity.map(|velocity| {
            let stored = store([0, 1].map(|axis| f64::from(velocity[axis]) / unit[axis]));
            [0, 1].map(|axis| (stored[axis] * unit[axis]) as f32)
        })
    }
}

/// Stores parts of the distance from the centre to the border.
fn linear8(parts: [f64; 2]) -> [f64; 2] {
    parts.map(|part| 2.0 * unorm(0.5 + 0.5 * part, 8) - 1.0)
}

/// Stores parts of the distance from the centre to the border.
fn polar_sqrt8(parts: [f64; 2]) -> [f64; 2] {
    match parts[0].hypot(parts[1]) {
        0.0 => [0.0; 2],
        length => {
            let stored = unorm(length.sqrt(), 8).powi(2);
            linear8(parts.map(|part| part / length)).map(|direction| direction * stored)
        }
    }
}

/// Stores half the smear, relative to the longest one.
fn kino10(half: [f64; 2]) -> [f64; 2] {
    let shortened = half[0].hypot(half[1]).max(1.0);
    // 512 of 1023 is exactly 0, so that still pixels stay still.
    half.map(|part| ((512.0 + 511.0 * part / shortened).round() - 512.0) / 511.0)
}

/// Stores half the smear, in pixels.
fn tile_clamped(half: [f64; 2]) -> [f64; 2] {
    match half[0].hypot(half[1]) {
        0.0 => half,
        length => half.map(|part| part / length * length.clamp(0.5, TILE)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_linear_bits_err_by_half_a_step_and_do_not_know_stillness() {
        for part in [-0.94, -0.01, 0.0, 0.002, 0.125] {
            let [value, _] = linear8([part, 0.0]);
            assert!((value - part).abs() <= 1.0 / 255.0 + 1e-9, "{value}");
        }
        // 128 of 255 is 1 / 255 too much.
        assert!(
            linear8([0.0; 2])
                .iter()
                .all(|part| (part - 1.0 / 255.0).abs() < 1e-9)
        );
    }

    #[test]
    fn a_square_root_makes_slow_motion_finer() {
        assert_eq!(polar_sqrt8([0.0; 2]), [0.0; 2]);
        // The step of the square is twice the root times the root's step.
        for part in [0.0003_f64, 0.003, 0.03, 0.3] {
            let half_step = (2.0 * part.sqrt() + 1.0 / 255.0) * 0.5 / 255.0;
            let error = (polar_sqrt8([part, 0.0])[0] - part).abs();
            assert!(error <= half_step + 0.01 * part, "{error} at {part}");
        }
        assert!((polar_sqrt8([0.003, 0.0])[0] - 0.003).abs() < 0.0003);
        assert!(linear8([0.003, 0.0])[0] > 0.0037);
    }

    #[test]
    fn kino_keeps_stillness_and_cuts_at_its_radius() {
        assert_eq!(kino10([0.0; 2]), [0.0; 2]);
        let [x, y] = kino10([1.5, -2.0]);
        assert!((x.hypot(y) - 1.0).abs() < 0.003 && (x / -y - 0.75).abs() < 0.01);
        assert!((kino10([0.28, 0.0])[0] - 0.28).abs() <= 0.5 / 511.0 + 1e-9);
    }

    #[test]
    fn a_tile_bounds_motion_on_both_sides() {
        assert_eq!(tile_clamped([0.0, 0.0]), [0.0, 0.0]);
        assert_eq!(tile_clamped([0.0, -90.0]), [0.0, -20.0]);
        assert_eq!(tile_clamped([0.125, 0.0]), [0.5, 0.0]);
        assert_eq!(tile_clamped([3.0, 4.0]), [3.0, 4.0]);
    }
}
