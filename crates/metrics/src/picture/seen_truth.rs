//! Colour of a truth, prepared once for all pictures that are measured against it.

use frame::Image;

use crate::Viewing;
use crate::color::flip::{Displayed, SeenExposures};
use crate::color::grain::GrainTruth;

/// The truth's mean as a display shows it and as FLIP sees it.
pub struct SeenTruth {
    /// The truth in sRGB.
    pub srgb: Image,
    /// The truth as LDR-FLIP sees it.
    pub display: SeenExposures,
    /// The truth as HDR-FLIP sees it.
    pub exposures: SeenExposures,
    /// The truth for grain.
    pub grain: GrainTruth,
    /// Factor from radiance to display.
    pub scale: f64,
}

impl SeenTruth {
    /// Prepares the colour of the truth's mean and halves.
    pub fn new(mean: &Image, halves: [&Image; 2], viewing: &Viewing) -> Self {
        let displayed = Displayed::new(mean, viewing);
        Self {
            display: SeenExposures::of_display(&displayed),
            srgb: displayed.srgb,
            exposures: SeenExposures::new(mean, viewing),
            grain: GrainTruth::new(mean, halves, viewing.scale()),
            scale: viewing.scale(),
        }
    }
}
