//! Frames with several samples per pixel (MSAA): colour is their mean, velocity and depth come from
//! one of them.

use frame::{ColorSampling, Frame, Raster, Size};
use tracer::{PixelGrid, RenderSettings};

use super::renderer::Renderer;
use crate::render::settings::settings_of;
use crate::{Error, named};

/// Offsets of the four samples from the pixel's top left corner, in pixels: the standard pattern of
/// Direct3D and Vulkan.
const SAMPLES: [[f64; 2]; 4] = [
    [0.375, 0.125],
    [0.875, 0.375],
    [0.125, 0.625],
    [0.625, 0.875],
];

named! {
    /// Sample, of four per pixel, that velocity and depth are taken from.
    pub enum Multisampling {
        /// No samples: colour over the whole pixel, velocity and depth at its centre.
        None = "none",
        /// Velocity and depth of sample 0.
        First = "first",
        /// Velocity and depth of the nearest of the four samples.
        Nearest = "nearest",
        /// Velocity and depth of the farthest of the four samples.
        Farthest = "farthest",
    }
}

impl Multisampling {
    /// Returns the frame as resolved from four samples per pixel.
    pub(crate) fn apply(self, frame: Frame, renderer: &Renderer) -> Result<Frame, Error> {
        if self == Self::None {
            return Ok(frame);
        }
        let samples = SAMPLES.iter().zip(sample_settings(&frame));
        let samples = samples.map(|(place, settings)| {
            let grid = PixelGrid {
                size: settings.size(),
                offset: place.map(|part| part - 0.5),
            };
            renderer.frame("frame with 4 samples per pixel", &settings, &grid)
        });
        Ok(self.resolve(frame, &samples.collect::<Result<Vec<_>, _>>()?))
    }

    /// Averages colour and coverage of the samples, and takes velocity and depth from one of them.
    fn resolve(self, frame: Frame, samples: &[Frame]) -> Frame {
        let Size { width, height } = frame.size();
        let taken = Raster::from_fn(width, height, |x, y| {
            self.choose(samples.iter().map(|sample| *sample.depth.at(x, y)))
        });
        let each = |x: u32, y: u32| &samples[*taken.at(x, y)];
        let count = samples.len() as f32;
        let mean = |of: &dyn Fn(&Frame) -> f32| samples.iter().map(of).sum::<f32>() / count;
        let coverage = (0..frame.coverage.len()).map(|object| {
            let at = |x, y| mean(&|sample| *sample.coverage[object].at(x, y));
            Raster::from_fn(width, height, at)
        });
        Frame {
            color: Raster::from_fn(width, height, |x, y| {
                [0, 1, 2].map(|band| mean(&|sample| sample.color.at(x, y)[band]))
            }),
            coverage: coverage.collect(),
            velocity: Raster::from_fn(width, height, |x, y| *each(x, y).velocity.at(x, y)),
            velocity_next: take_further(&taken, samples, |sample| sample.velocity_next.as_ref()),
            velocity_z: take_further(&taken, samples, |sample| sample.velocity_z.as_ref()),
            depth: Raster::from_fn(width, height, |x, y| *each(x, y).depth.at(x, y)),
            object_id: Raster::from_fn(width, height, |x, y| *each(x, y).object_id.at(x, y)),
            ..frame
        }
    }

    /// Chooses a sample by the depths of all; the first among equals.
    fn choose(self, depths: impl Iterator<Item = f32>) -> usize {
        let chosen = depths
            .enumerate()
            .reduce(|best, sample| match (self, sample.1 < best.1) {
                (Self::Nearest, true) => sample,
                (Self::Farthest, _) if sample.1 > best.1 => sample,
                _ => best,
            });
        chosen.map_or(0, |(index, _)| index)
    }
}

/// Takes from the chosen samples a raster that few frames have; none if a sample lacks it.
fn take_further<T: Copy>(
    taken: &Raster<usize>,
    samples: &[Frame],
    raster: fn(&Frame) -> Option<&Raster<T>>,
) -> Option<Raster<T>> {
    let rasters: Option<Vec<&Raster<T>>> = samples.iter().map(raster).collect();
    let rasters = rasters?;
    let at = |x, y| *rasters[*taken.at(x, y)].at(x, y);
    Some(Raster::from_fn(taken.width, taken.height, at))
}

/// Lists the settings of the four samples: each has a quarter of the frame's rays, at one offset,
/// and its own random numbers.
fn sample_settings(frame: &Frame) -> [RenderSettings; 4] {
    let mut settings = settings_of(frame);
    settings.options.color = ColorSampling::Point;
    let least = settings.replicates;
    settings.samples_per_pixel = (settings.samples_per_pixel / SAMPLES.len() as u32).max(least);
    [1, 2, 3, 4].map(|sample| RenderSettings {
        seed: settings.seed.wrapping_add(sample),
        ..settings
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inputs::test_frame::test_frame;

    #[test]
    fn colour_is_the_mean_and_depth_is_that_of_the_chosen_sample() {
        let samples = [(5.0, 0.0), (2.0, 4.0), (9.0, 0.0), (2.0, 8.0)].map(|(depth, red)| Frame {
            color: Raster::filled(1, 1, [red, 0.0, 1.0]),
            velocity: Raster::filled(1, 1, [depth, red]),
            depth: Raster::filled(1, 1, depth),
            coverage: vec![Raster::filled(1, 1, f32::from(depth > 4.0))],
            ..test_frame(1, 1)
        });
        for (choice, depth, red) in [
            (Multisampling::First, 5.0, 0.0),
            (Multisampling::Nearest, 2.0, 4.0),
            (Multisampling::Farthest, 9.0, 0.0),
        ] {
            let resolved = choice.resolve(test_frame(1, 1), &samples);
            assert_eq!(resolved.velocity.pixels, [[depth, red]]);
            assert_eq!(resolved.depth.pixels, [depth]);
            assert_eq!(resolved.color.pixels, [[3.0, 0.0, 1.0]]);
            assert_eq!(resolved.coverage[0].pixels, [0.5]);
        }
    }

    #[test]
    fn samples_share_the_rays_of_a_pixel_and_no_random_numbers() {
        let mut frame = test_frame(4, 3);
        frame.provenance.seed = u64::MAX;
        frame.provenance.replicates = 2;
        // Every replicate has a sample at least.
        for (samples_per_pixel, share) in [(64, 16), (4, 2)] {
            frame.provenance.samples_per_pixel = samples_per_pixel;
            let settings = sample_settings(&frame);
            assert!(settings.iter().all(|part| part.samples_per_pixel == share));
            assert_eq!(settings.map(|part| part.seed), [0, 1, 2, 3]);
        }
    }
}
