//! The colours of a truth, for pictures that have another truth of their own.

use frame::{Image, Picture, Raster};

use super::shared_noise::halves_for;
use super::{Reference, explain_empty};
use crate::color::flip::Displayed;
use crate::picture::error_maps::ErrorMaps;
use crate::picture::pooled::Pooled;
use crate::picture::scores::score_image;
use crate::picture::seen_truth::SeenTruth;
use crate::reference::check::check_brightness;
use crate::{ImageScores, MeasureError, Region, Regions, Viewing};

/// The colours of a truth where anything moves. It takes a fraction of the memory of the
/// [`Reference`] that it is made from.
pub struct ColorReference {
    halves: [Image; 2],
    /// The mean, with the coverage of the background alone.
    mean: Picture,
    instant: Image,
    shared: Raster<bool>,
    seen: SeenTruth,
    viewing: Viewing,
    regions: Regions,
    windows: Raster<bool>,
    noise: Option<Pooled>,
}

impl From<Reference<'_>> for ColorReference {
    fn from(reference: Reference) -> Self {
        let mut mean = reference.mean;
        mean.coverage.truncate(1);
        Self {
            halves: (reference.truth.halves.each_ref()).map(|half| half.color.clone()),
            mean,
            instant: reference.instant,
            shared: reference.shared,
            seen: reference.seen,
            viewing: reference.viewing,
            regions: reference.regions,
            windows: reference.windows,
            noise: reference.errors.noise[Region::Moving as usize],
        }
    }
}

impl ColorReference {
    /// Measures the errors of colour, where anything moves, of a picture that its own reference has
    /// measured: it is finite, and has the truth's size.
    pub fn measure(&self, output: &Picture) -> Result<ImageScores, MeasureError> {
        check_brightness(output, &self.viewing, "the output")?;
        let displayed = Displayed::new(&output.color, &self.viewing);
        let halves = self.halves.each_ref();
        let mean = &self.mean.color;
        let halves = halves_for(&output.color, &self.instant, &self.shared, halves, mean);
        let errors = ErrorMaps::new(
            output,
            &displayed,
            halves.each_ref(),
            &self.mean,
            &self.seen,
        );
        let pooled = Pooled::new(&errors, &self.regions, Region::Moving, &self.windows);
        let found = pooled.zip(self.noise);
        Ok(score_image(&found.ok_or(explain_empty(Region::Moving))))
    }
}
