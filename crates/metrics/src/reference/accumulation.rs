//! Accumulations, which share the noise of the truth that they are measured against.

use frame::{Accumulation, Image, Picture};

use super::check::{check_picture, check_rung};
use super::{Reference, Sharp};
use crate::math::raster::zip_pixels;
use crate::skill::Ends;
use crate::subframes::{Equivalent, Subframes};
use crate::{EquivalentMetric, MeasureError, Measured, Measurement};

const RENDERED: &str = "the picture was rendered by itself, not made from the frame";

impl Reference<'_> {
    /// Adds the pictures that skill is measured between. `sharp` shows the instant in the middle of
    /// the shutter and has a skill of 0; `best` is the one-frame oracle's, the best that one frame
    /// can give, and has 1. Without them skill does not apply.
    pub fn with_ends(mut self, sharp: &Sharp, best: &Picture) -> Result<Self, MeasureError> {
        let what = "the sharp picture of the shutter's middle";
        check_picture(best, self.truth, "the one-frame oracle")?;
        let sharp = match sharp {
            Sharp::Frame(picture) => {
                check_picture(picture, self.truth, what)?;
                self.pool_moving(picture, self.half_colors())
            }
            Sharp::Accumulation(rung) => {
                check_rung(rung, self.truth, what)?;
                let picture = rung.picture(&self.mean);
                let halves = rung
                    .halves()
                    .map(|half| subtract(&picture.color, &half.color));
                self.pool_moving(&picture, halves.each_ref())
            }
        };
        let ends = sharp.zip(self.pool_moving(best, self.half_colors()));
        self.errors.ends = ends.map(|(sharp, best)| Ends { sharp, best });
        Ok(self)
    }

    /// Measures the picture of an accumulation of the same shutter. It has the truth's noise, so
    /// that only its difference from the truth counts as error; its equivalent sub-frames are its
    /// own.
    pub fn measure_accumulation(&self, rung: &Accumulation) -> Result<Measurement, MeasureError> {
        let what = format!("the accumulation of {} sub-frames", rung.subframes);
        check_rung(rung, self.truth, &what)?;
        let picture = rung.picture(&self.mean);
        let differences = rung.halves().map(|half| half.color);
        let halves = [0, 1].map(|half| subtract(&picture.color, &differences[half]));
        // Each half of the picture is compared with its own half of the truth, whose noise it
        // shares.
        let colors = self.half_colors();
        let frozen = [0, 1].map(|half| {
            let shading = subtract(colors[half], self.frozen.halves()[half]);
            subtract(&halves[half], &shading)
        });
        let mut measurement =
            self.measure_against(&picture, halves.each_ref(), frozen.each_ref())?;
        measurement.scores.static_contamination = Measured::not_applicable(RENDERED);
        let counts = &mut measurement.scores.equivalent_subframes;
        for metric in EquivalentMetric::ALL {
            if let Equivalent::Subframes(count) = counts.get(metric).clone() {
                let subframes = Subframes::of_rung(rung.subframes, count.floor);
                *counts.get_mut(metric) = Equivalent::Subframes(subframes);
            }
        }
        Ok(measurement)
    }
}

/// Subtracts an image from another.
fn subtract(a: &Image, b: &Image) -> Image {
    zip_pixels(a, b, |a, b| std::array::from_fn(|c| a[c] - b[c]))
}
