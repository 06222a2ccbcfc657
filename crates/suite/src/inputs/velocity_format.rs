//! Formats of the velocity buffer.

use frame::{Frame, Vectors};
use half::f16;

use crate::inputs::unorm::unorm;
use crate::named;

/// Tile, and longest half-velocity, of McGuire et al. 2012, in pixels.
const TILE: f64 = 20.0;
/// Longest half-velocity of KinoMotion, as a part of the picture's height.
const KINO_RADIUS: f64 = 0.05;

named! {
    /// A format of the velocity buffer.
    pub enum VelocityFormat {
        /// 32-bit floats of pixels.
        Float32 = "float32",
        /// 16-bit floats of pixels.
        Float16 = "float16",
        /// Twice 8 bits, linear: 0.5 + 0.5 x, where 1 is the whole way from the centre to the border. Standing still is none of the
        /// values.
        Linear8 = "linear8",
        /// Three times 8 bits: the unit direction, linear, and the square root of the length, where 1 is the way from the
        /// centre to the border.
        PolarSqrt8 = "polar_sqrt8",
        /// Twice 10 bits of half the smear, linear up to a twentieth of the picture's height, as KinoMotion packs it.
        Kino10 = "kino10",
        /// Half the smear, no longer than a tile of 20 pixels and no shorter than half a pixel (McGuire et al. 2012).
        TileClamped = "tile_clamped",
    }
}

impl VelocityFormat {
    /// Returns the frame's velocity as it comes out of this buffer.
    pub(crate) fn apply(self, frame: &Frame) -> Vectors {
        let picture = [frame.color.width, frame.color.height]
            .map(|side| f64::from(side - 2 * frame.guard_band));
        let half_smear = 0.5 * frame.exposure;
        frame.velocity.map(|velocity| {
            let stored = velocity.map(f64::from);
            match self {
                Self::Float32 => *velocity,
                Self::Float16 => velocity.map(|part| f16::from_f32(part).to_f32()),
                Self::Linear8 => linear8(stored, picture),
                Self::PolarSqrt8 => polar_sqrt8(stored, picture),
                Self::Kino10 => {
                    let radius = KINO_RADIUS * picture[1];
                    kino10(stored.map(|part| part * half_smear), radius)
                        .map(|part| (part / half_smear) as f32)
                }
                Self::TileClamped => tile_clamped(stored.map(|part| part * half_smear))
                    .map(|part| (part / half_smear) as f32),
            }
        })
    }
}

fn linear8(velocity: [f64; 2], picture: [f64; 2]) -> [f32; 2] {
    [0, 1].map(|axis| {
        let to_border = 0.5 * picture[axis];
        let stored = unorm(0.5 + 0.5 * velocity[axis] / to_border, 8);
        ((2.0 * stored - 1.0) * to_border) as f32
    })
}

fn polar_sqrt8(velocity: [f64; 2], picture: [f64; 2]) -> [f32; 2] {
    let parts = [0, 1].map(|axis| velocity[axis] / (0.5 * picture[axis]));
    let length = parts[0].hypot(parts[1]);
    if length == 0.0 {
        return [0.0; 2];
    }
    let stored = unorm(length.sqrt(), 8).powi(2);
    [0, 1].map(|axis| {
        let direction = 2.0 * unorm(0.5 + 0.5 * parts[axis] / length, 8) - 1.0;
        (direction * stored * 0.5 * picture[axis]) as f32
    })
}

fn kino10(half: [f64; 2], radius: f64) -> [f64; 2] {
    let length = half[0].hypot(half[1]);
    let shortened = (radius / length).min(1.0);
    half.map(|part| {
        let unit = if length > 0.0 {
            part * shortened / radius
        } else {
            0.0
        };
        // 512 of 1023 stands for 0, so that what stands still does.
        let stored = (512.0 + 511.0 * unit).round();
        (stored - 512.0) / 511.0 * radius
    })
}

fn tile_clamped(half: [f64; 2]) -> [f64; 2] {
    let length = half[0].hypot(half[1]);
    if length == 0.0 {
        return half;
    }
    half.map(|part| part / length * length.clamp(0.5, TILE))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PICTURE: [f64; 2] = [640.0, 360.0];

    #[test]
    fn eight_linear_bits_err_by_half_a_step_and_do_not_know_stillness() {
        let step = 320.0 / 255.0 * 2.0;
        for speed in [-300.0, -3.0, 0.0, 0.7, 40.0] {
            let [x, _] = linear8([speed, 0.0], PICTURE);
            assert!(
                (f64::from(x) - speed).abs() <= 0.5 * step + 1e-4,
                "{x} for {speed}"
            );
        }
        let [x, y] = linear8([0.0, 0.0], PICTURE);
        // 128 of 255 is 1 / 255 too much.
        assert!((x - 320.0 / 255.0).abs() < 1e-4 && (y - 180.0 / 255.0).abs() < 1e-4);
    }

    #[test]
    fn a_square_root_makes_slow_motion_finer() {
        assert_eq!(polar_sqrt8([0.0, 0.0], PICTURE), [0.0, 0.0]);
        let error = |speed: f64| (f64::from(polar_sqrt8([speed, 0.0], PICTURE)[0]) - speed).abs();
        // The step of the square is twice the root times the root's step.
        for speed in [0.1, 1.0, 10.0, 100.0] {
            let root = (speed / 320.0_f64).sqrt();
            let half_step = 320.0 * (2.0 * root + 1.0 / 255.0) * 0.5 / 255.0;
            assert!(
                error(speed) <= half_step + 0.01 * speed,
                "{} at {speed}",
                error(speed)
            );
        }
        assert!(error(1.0) < 0.1 && linear8([1.0, 0.0], PICTURE)[0] > 1.2);
    }

    #[test]
    fn kino_keeps_stillness_and_cuts_at_its_radius() {
        assert_eq!(kino10([0.0, 0.0], 18.0), [0.0, 0.0]);
        let [x, y] = kino10([30.0, -40.0], 18.0);
        assert!((x.hypot(y) - 18.0).abs() < 0.05 && (x / -y - 0.75).abs() < 0.01);
        let [x, _] = kino10([5.0, 0.0], 18.0);
        assert!((x - 5.0).abs() <= 0.5 * 18.0 / 511.0 + 1e-9);
    }

    #[test]
    fn a_tile_bounds_motion_on_both_sides() {
        assert_eq!(tile_clamped([0.0, 0.0]), [0.0, 0.0]);
        assert_eq!(tile_clamped([0.0, -90.0]), [0.0, -20.0]);
        assert_eq!(tile_clamped([0.125, 0.0]), [0.5, 0.0]);
        assert_eq!(tile_clamped([3.0, 4.0]), [3.0, 4.0]);
    }
}
