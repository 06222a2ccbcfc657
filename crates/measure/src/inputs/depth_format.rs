//! Formats of the depth buffer.

use frame::{FAR_DEPTH, Plane};
use half::f16;

use crate::named;

/// Near plane of reversed depth, in metres.
const NEAR: f64 = 0.1;

named! {
    /// Format of the depth buffer.
    pub enum DepthFormat {
        /// Metres as 32-bit floats.
        Float32 = "float32",
        /// Metres as 16-bit floats.
        Float16 = "float16",
        /// Near plane / depth in 24 bits; the near plane at 0.1 m.
        Reversed24 = "reversed24",
        /// Near plane / depth as 32-bit floats.
        Reversed32 = "reversed32",
    }
}

impl DepthFormat {
    /// Returns depth as read from this buffer.
    pub(crate) fn apply(self, depth: &Plane) -> Plane {
        depth.map(|&depth| match self {
            Self::Float32 => depth,
            // The background's mark is its far depth, which must not change.
            _ if depth == FAR_DEPTH => depth,
            Self::Float16 => f16::from_f32(depth).to_f32().min(f16::MAX.to_f32()),
            Self::Reversed24 => match unorm(NEAR / f64::from(depth), 24) {
                0.0 => FAR_DEPTH,
                stored => (NEAR / stored) as f32,
            },
            Self::Reversed32 => {
                let stored = (NEAR / f64::from(depth)) as f32;
                (NEAR / f64::from(stored)) as f32
            }
        })
    }
}

/// Rounds a number in [0, 1] to a number of bits.
pub(super) fn unorm(value: f64, bits: u32) -> f64 {
    let steps = f64::from((1_u32 << bits) - 1);
    (value.clamp(0.0, 1.0) * steps).round() / steps
}

#[cfg(test)]
mod tests {
    use frame::Raster;

    use super::*;

    #[test]
    fn reversed_depth_is_finest_near_and_background_stays_far() {
        let errors = |format: DepthFormat| {
            let error =
                |depth| (format.apply(&Raster::filled(1, 1, depth)).pixels[0] - depth).abs();
            assert_eq!(error(FAR_DEPTH), 0.0);
            [0.5_f32, 30.0, 900.0].map(error)
        };
        // z^2 / near steps of 2^-24, half of one at most.
        let reversed = errors(DepthFormat::Reversed24);
        for (error, depth) in reversed.iter().zip([0.5, 30.0, 900.0]) {
            assert!(*error <= depth * depth / 0.1 * 0.51 / 16_777_215.0 + depth * 1e-7);
        }
        assert!(reversed[2] > 0.01);
        // Ten bits after the leading one.
        assert!(errors(DepthFormat::Float16)[2] <= 900.0 / 2048.0);
        assert!(errors(DepthFormat::Reversed32)[2] < 1e-3);
    }
}
