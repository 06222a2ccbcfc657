//! Exposures at which pictures are compared.

use frame::Display;

/// The photographic exposures of a comparison; a scene declares them, so that no picture chooses
/// its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewing {
    /// Exposure of LDR-FLIP, PSNR, MSE and relMSE, in stops: radiance times `2^stops` is 1 at
    /// display white.
    pub stops: f32,
    /// Darkest exposure of HDR-FLIP, in stops.
    pub flip_start: f32,
    /// Brightest exposure of HDR-FLIP, in stops.
    pub flip_stop: f32,
    /// Number of exposures that HDR-FLIP takes its maximum over, both ends included; 2 to 128.
    pub flip_count: u32,
}

impl Viewing {
    /// Returns the factor from radiance to display.
    pub fn scale(&self) -> f64 {
        f64::from(self.stops).exp2()
    }
}

impl From<Display> for Viewing {
    fn from(display: Display) -> Self {
        Self {
            stops: display.stops,
            flip_start: display.flip.start,
            flip_stop: display.flip.stop,
            flip_count: display.flip.count,
        }
    }
}
