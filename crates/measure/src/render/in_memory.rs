//! Renders that stay in memory: a frame with its truth, for callers that want no files.

use frame::{Alignment, Image, Ladder, Picture, Size, TracedFrame, Truth};
use scene::Scene;
use tracer::{LadderTracer, MAX_SAMPLES, PixelGrid, RenderSettings, trace_frame_part, trace_truth};

use super::exclusion::{FilterFrame, draw_exclusion};
use super::memory::check_memory;
use super::settings::SIDES;
use super::truths::deciding_floor;
use super::velocities::add_further_velocities;
use crate::{Error, LADDER, Monitor, SHARP};

/// Noise falls with this power of the samples: faster than with their root, since they are
/// stratified. Measured on nine scenes, from 64 to 512 samples: 0.58 to 0.73.
const DECAY: f64 = 0.63;
/// Part of the predicted samples that is rendered, so that few predictions fail: pixels get powers of
/// two, and numbers in between are up to 8 % noisier.
const MARGIN: f64 = 1.1;
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
    /// Upper limit on the noise of truth and frame, a root mean square of radiance. Each gets the
    /// samples that it needs for it, and no fewer than the settings have. None means the samples of
    /// the settings.
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
        // Shared out anew, samples that must be refused would be allowed.
        self.settings.check_truth(self.scene, self.alignment)?;
        let [for_truth, for_frame] = match self.noise {
            Some(noise) => self.with_samples(0.0)?.predict_samples(noise)?,
            None => [0.0; 2],
        };
        let (of_truth, truth, _) = self.trace_until_clean(for_truth, Self::trace_noisy_truth)?;
        let (of_frame, traced, frame_noise) =
            self.trace_until_clean(for_frame, Self::trace_noisy_frame)?;
        let grid = PixelGrid::of_picture(self.settings.width, self.settings.height);
        let frame = add_further_velocities(traced.frame, self.scene, &of_frame.settings, &grid)?;
        Ok(RenderedScene {
            frame: FilterFrame {
                exclusion: Some(draw_exclusion(&frame, self.scene)),
                frame,
            },
            frame_noise,
            sharp: of_truth.trace_sharp(&truth)?,
            subframes: of_frame.trace_subframes(&truth)?,
            truth,
        })
    }

    /// Traces a truth or a frame, which comes with its noise, until it reaches the noise that is
    /// asked for; begins with `needed` samples per pixel. Returns what rendered it, too.
    fn trace_until_clean<T>(
        &self,
        mut needed: f64,
        trace: impl Fn(&Self) -> Result<(T, f64), Error>,
    ) -> Result<(Self, T, f64), Error> {
        loop {
            let render = self.with_samples(needed)?;
            let (traced, noise) = trace(&render)?;
            let excess = noise / self.noise.unwrap_or(f64::INFINITY);
            if excess <= 1.0 {
                return Ok((render, traced, noise));
            }
            needed = render.predict(excess);
        }
    }

    /// Predicts how many samples per pixel the noise of truth and frame takes, from small renders
    /// with the samples of the settings.
    pub(crate) fn predict_samples(&self, noise: f64) -> Result<[f64; 2], Error> {
        let measure = |settings| -> Result<[f64; 2], Error> {
            let small = Self { settings, ..*self };
            let (_, of_truth) = small.trace_noisy_truth()?;
            let (_, of_frame) = small.trace_noisy_frame()?;
            Ok([of_truth, of_frame])
        };
        let [quarter, half] = small_settings(self.settings).map(measure);
        let (quarter, half) = (quarter?, half?);
        Ok([0, 1].map(|which| self.predict(extrapolate(quarter[which], half[which]) / noise)))
    }

    /// Shares at least `needed` samples per pixel out if there is a noise to reach, no fewer than
    /// the settings have.
    fn with_samples(&self, needed: f64) -> Result<Self, Error> {
        let Some(noise) = self.noise else {
            return Ok(*self);
        };
        let needed = needed.max(self.settings.samples_per_pixel.into());
        let settings = share_samples(self.settings, needed).ok_or_else(|| {
            Error::TooNoisy(format!(
                "{} {}: about {needed:.0} samples per pixel are needed for a noise of {noise:e}; \
                 allowed: {}; allow more noise",
                self.scene.id,
                self.alignment,
                REPLICATES * MAX_SAMPLES
            ))
        })?;
        Ok(Self { settings, ..*self })
    }

    /// Predicts the samples per pixel that lower the noise by the factor `excess`.
    fn predict(&self, excess: f64) -> f64 {
        f64::from(self.settings.samples_per_pixel) * MARGIN * excess.powf(1.0 / DECAY)
    }

    /// Traces the truth; returns it with its noise.
    fn trace_noisy_truth(&self) -> Result<(Truth, f64), Error> {
        let label = format!("{} {}", self.scene.id, self.alignment);
        self.settings.check_truth(self.scene, self.alignment)?;
        check_memory(self.scene, &self.settings, self.settings.replicates)?;
        let truth = (self.monitor).watch(&label, |watch| {
            trace_truth(self.scene, &self.settings, self.alignment, watch)
        })?;
        let (_, floor) = deciding_floor(&truth);
        Ok((truth, floor))
    }

    /// Traces the frame; returns it with its noise.
    fn trace_noisy_frame(&self) -> Result<(TracedFrame, f64), Error> {
        let traced = self.trace_frame(self.scene)?;
        let noise = estimate_frame_noise(&traced.replicates);
        Ok((traced, noise))
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

/// Returns the settings of the renders that predict the noise: a quarter and a half of the sides.
pub(crate) fn small_settings(settings: RenderSettings) -> [RenderSettings; 2] {
    [4, 2].map(|part| {
        let small = |side: u32| side.div_ceil(part).max(*SIDES.start());
        RenderSettings {
            guard_band: 0,
            ..settings.with_size(Size::new(small(settings.width), small(settings.height)))
        }
    })
}

/// Extrapolates the noise of a picture from renders of a quarter and of a half of its sides. Larger
/// pixels hold more edges, so noise falls from size to size, and by about the root of the factor each
/// time: that is within 3 % on six scenes from 160x90 to 640x360.
fn extrapolate(quarter: f64, half: f64) -> f64 {
    half * (half / quarter).min(1.0).sqrt()
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
    fn noise_falls_half_as_much_again_from_half_size_to_full_size() {
        assert_eq!(extrapolate(0.8, 0.2), 0.1);
        // It does not rise, and none stays none.
        assert_eq!(extrapolate(0.2, 0.3), 0.3);
        assert_eq!(extrapolate(0.0, 0.0), 0.0);
    }

    #[test]
    fn renders_that_predict_the_noise_are_no_smaller_than_a_picture_may_be() {
        let sides = |width, height| {
            let settings = RenderSettings::default().with_size(Size::new(width, height));
            small_settings(settings).map(|small| (small.width, small.height))
        };
        assert_eq!(sides(321, 180), [(81, 45), (161, 90)]);
        assert_eq!(sides(40, 16), [(16, 16), (20, 16)]);
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
