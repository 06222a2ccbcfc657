//! Renders that stay in memory: a frame with its truth, for callers that want no files.

use frame::{Alignment, Image, Ladder, Picture, TracedFrame, Truth};
use scene::Scene;
use tracer::{LadderTracer, MAX_SAMPLES, PixelGrid, RenderSettings, trace_frame_part, trace_truth};

use super::exclusion::{FilterFrame, draw_exclusion};
use super::memory::check_memory;
use super::truths::deciding_floor;
use super::velocities::add_further_velocities;
use crate::{Error, LADDER, Monitor, SHARP};

/// Noise falls with this power of the samples: faster than with their root, since they are
/// stratified. Measured on nine scenes, from 64 to 512 samples: 0.58 to 0.73.
const DECAY: f64 = 0.6;
/// Part of the predicted samples that is rendered, so that few predictions fail: pixels get powers of
/// two, and numbers in between are up to 8 % noisier.
const MARGIN: f64 = 1.15;
/// Replicates of a clean truth. More of them would stratify worse, and fewer would hardly know each
/// pixel's error.
const REPLICATES: u32 = 4;

/// A scene, and what to render of it.
#[derive(Clone, Copy)]
pub struct MemoryRender<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Settings of the frame, the truth and the sub-frames.
    pub settings: RenderSettings,
    /// Shutter of the truth.
    pub alignment: Alignment,
    /// Upper limit on the noise of truth and frame, a root mean square of radiance. They are
    /// rendered with more samples until both reach it. None means the samples of the settings.
    pub noise: Option<f64>,
    /// Sharp pictures to render over the shutter; each takes as long as the frame.
    pub subframes: u32,
    /// Shows progress, and ends the work.
    pub monitor: Monitor,
}

/// A frame with its truth, and all that a picture of it is scored with.
pub struct RenderedScene {
    /// The frame, with everything that a filter may read.
    pub frame: FilterFrame,
    /// Noise of the frame's colour, a root mean square of radiance over the picture.
    pub frame_noise: f64,
    /// The truth.
    pub truth: Truth,
    /// The sharp picture of the shutter's middle, the zero of skill, as a ladder of one rung; none
    /// if the frame shows it.
    pub sharp: Option<Ladder>,
    /// Sharp pictures at the middles of equal parts of the shutter, the earliest first.
    pub subframes: Vec<Image>,
}

impl MemoryRender<'_> {
    /// Renders everything.
    ///
    /// # Errors
    /// The settings do not fit the scene, memory does not suffice, the noise cannot be reached, or
    /// the monitor interrupted.
    pub fn render(&self) -> Result<RenderedScene, Error> {
        if let Some(noise) = self.noise.filter(|noise| noise.is_nan() || *noise <= 0.0) {
            return Err(Error::Refused(format!(
                "noise is {noise}; allowed: numbers above 0, such as 0.002"
            )));
        }
        // Sharing out anew would mend what must be refused.
        self.settings.check_truth(self.scene, self.alignment)?;
        let mut start = *self;
        if self.noise.is_some() {
            let asked = self.settings.samples_per_pixel.into();
            start.settings = share_samples(self.settings, asked).unwrap_or(self.settings);
        }
        let (rendered, truth, traced) = start.trace_until_clean()?;
        let frame_noise = estimate_frame_noise(&traced.replicates);
        let grid = PixelGrid::of_picture(self.settings.width, self.settings.height);
        let frame = add_further_velocities(traced.frame, self.scene, &self.settings, &grid)?;
        Ok(RenderedScene {
            frame: FilterFrame {
                exclusion: Some(draw_exclusion(&frame, self.scene)),
                frame,
            },
            frame_noise,
            sharp: rendered.trace_sharp(&truth)?,
            subframes: rendered.trace_subframes(&truth)?,
            truth,
        })
    }

    /// Traces truth and frame, with more samples until both reach the noise; returns what rendered
    /// them, too.
    fn trace_until_clean(self) -> Result<(Self, Truth, TracedFrame), Error> {
        let (truth, traced) = (self.trace_truth()?, self.trace_frame(self.scene)?);
        let worst = worst_noise(&truth, &traced);
        let excess = worst / self.noise.unwrap_or(f64::INFINITY);
        if excess <= 1.0 {
            return Ok((self, truth, traced));
        }
        let samples = f64::from(self.settings.samples_per_pixel);
        let needed = self.predict(excess);
        let settings = share_samples(self.settings, needed).ok_or_else(|| {
            Error::TooNoisy(format!(
                "{} {}: the noise is {worst:.2e} with {samples} samples per pixel, and about {needed:.0} are needed for {:e}; \
                 allowed: {}; allow more noise",
                self.scene.id,
                self.alignment,
                worst / excess,
                REPLICATES * MAX_SAMPLES
            ))
        })?;
        Self { settings, ..self }.trace_until_clean()
    }

    /// Predicts from a render with the samples of the settings how many per pixel the noise takes.
    pub(crate) fn predict_samples(&self) -> Result<f64, Error> {
        let (truth, traced) = (self.trace_truth()?, self.trace_frame(self.scene)?);
        let worst = worst_noise(&truth, &traced);
        Ok(self.predict(worst / self.noise.unwrap_or(f64::INFINITY)))
    }

    /// Predicts the samples per pixel that lower the noise by the factor `excess`.
    fn predict(&self, excess: f64) -> f64 {
        f64::from(self.settings.samples_per_pixel) * MARGIN * excess.powf(1.0 / DECAY)
    }

    fn trace_truth(&self) -> Result<Truth, Error> {
        let label = format!("{} {}", self.scene.id, self.alignment);
        self.settings.check_truth(self.scene, self.alignment)?;
        check_memory(self.scene, &self.settings, self.settings.replicates)?;
        Ok((self.monitor).watch(&label, |watch| {
            trace_truth(self.scene, &self.settings, self.alignment, watch)
        })?)
    }

    fn trace_frame(&self, scene: &Scene) -> Result<TracedFrame, Error> {
        let settings = self.settings;
        let grid = PixelGrid::of_picture(settings.width, settings.height);
        let label = format!("{} frame", scene.id);
        Ok((self.monitor).watch(&label, |watch| {
            trace_frame_part(scene, &settings, &grid, None, watch)
        })?)
    }

    /// Traces the sharp picture of the shutter's middle as a run does, so that scores are the same.
    fn trace_sharp(&self, truth: &Truth) -> Result<Option<Ladder>, Error> {
        if self.alignment == Alignment::Centred {
            return Ok(None);
        }
        let tracer = LadderTracer::new(self.scene, &self.settings, truth, &LADDER)?;
        let label = format!("{} shutter's middle", self.scene.id);
        let rung = (self.monitor).watch(&label, |watch| tracer.trace(SHARP, watch))?;
        Ok(Some(rung))
    }

    fn trace_subframes(&self, truth: &Truth) -> Result<Vec<Image>, Error> {
        let middles = (0..self.subframes).map(|part| {
            truth
                .shutter
                .at((f64::from(part) + 0.5) / f64::from(self.subframes))
        });
        let trace = |time: f64| {
            let scene = self.scene.clone().later_by(time);
            let traced = self.trace_frame(&scene)?;
            Ok(traced.frame.color)
        };
        middles.map(trace).collect()
    }
}

/// Returns the noise of truth or frame, whichever is noisier.
fn worst_noise(truth: &Truth, traced: &TracedFrame) -> f64 {
    let (_, floor) = deciding_floor(truth);
    floor.max(estimate_frame_noise(&traced.replicates))
}

/// Shares at least `needed` samples per pixel out to few replicates; none if that is too many.
fn share_samples(settings: RenderSettings, needed: f64) -> Option<RenderSettings> {
    let each = (needed / f64::from(REPLICATES)).ceil();
    (each <= f64::from(MAX_SAMPLES)).then(|| RenderSettings {
        samples_per_pixel: each as u32 * REPLICATES,
        replicates: REPLICATES,
        ..settings
    })
}

/// Estimates the root mean square error of the mean of a frame's replicates, from the difference of
/// their halves: its expectation is twice the error.
fn estimate_frame_noise(replicates: &[Picture]) -> f64 {
    let half = |first: usize| Picture::mean(replicates.iter().skip(first).step_by(2)).color;
    let (a, b) = (half(0), half(1));
    let squares = a.pixels.iter().zip(&b.pixels).map(|(a, b)| {
        let square = |c: usize| (f64::from(a[c]) - f64::from(b[c])).powi(2);
        (square(0) + square(1) + square(2)) / 3.0
    });
    (squares.sum::<f64>() / a.pixels.len() as f64).sqrt() / 2.0
}

#[cfg(test)]
mod tests {
    use frame::Raster;

    use super::*;

    #[test]
    fn samples_are_shared_out_to_four_replicates() {
        let shared = |needed: f64| {
            let settings = share_samples(RenderSettings::default(), needed)?;
            Some((settings.samples_per_replicate(), settings.replicates))
        };
        assert_eq!(shared(64.0), Some((16, 4)));
        assert_eq!(shared(64.1), Some((17, 4)));
        assert_eq!(shared(4.0 * 65536.0), Some((65536, 4)));
        assert_eq!(shared(4.0 * 65536.0 + 1.0), None);
    }

    #[test]
    fn the_noise_of_a_frame_is_half_of_what_its_halves_differ_by() {
        let picture = |value: f32| Picture {
            color: Raster::filled(3, 2, [value; 3]),
            coverage: Vec::new(),
        };
        let noise =
            estimate_frame_noise(&[picture(0.25), picture(0.5), picture(0.25), picture(0.5)]);
        assert_eq!(noise, 0.125);
    }
}
