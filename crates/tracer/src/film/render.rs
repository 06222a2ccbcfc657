//! The samples of many pixels, summed in an order that does not depend on the number of threads.

use std::ops::Range;

use frame::{ColorSampling, Raster};
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use crate::error::TraceError;
use crate::film::at_instant::{InstantSums, InstantView};
use crate::film::canvas::Canvas;
use crate::film::eye::Eye;
use crate::film::means::{Estimate, Means};
use crate::film::sample_counts::SampleCounts;
use crate::film::shutter_sampler::ShutterSampler;
use crate::path::integrator::Integrator;
use crate::path::stops::visit_layers;
use crate::progress::Meter;
use crate::sampler::{Sampler, Stream, pixel_seed};
use crate::stage::Stage;

/// Pixels that a thread takes at a time; between two tasks it reports progress.
const PIXELS_PER_TASK: usize = 64;
/// A recalled pixel has one in so many of its samples shaded at the instant, too, and at least one
/// sample. One in eight would make the noise floor of frozen shading 2.5 times as high.
const ONE_RECALLED_IN: u32 = 4;

/// Times of the samples of a picture.
#[derive(Clone, Copy)]
pub(crate) enum Times<'a> {
    /// The instant `t = 0`.
    Instant,
    /// Times spread evenly over the light that passes the shutter.
    Shutter(&'a ShutterSampler),
    /// The middles of this many equal parts of that light.
    Midpoints(&'a ShutterSampler, u32),
}

/// The parameters of a render, the same for every pixel.
pub(crate) struct Film<'a> {
    pub integrator: Integrator<'a>,
    pub canvas: Canvas,
    /// Places of the samples: spread evenly over the pixel's area, or its centre.
    pub color: ColorSampling,
    /// Times of each picture that is rendered; a sample at a time of several pictures is traced
    /// once.
    pub times: &'a [Times<'a>],
    /// View of the instant, if samples are looked up there; the stage must then hold `t = 0`.
    pub instant: Option<InstantView>,
    /// Per picture, the pixels whose first samples are shaded at the instant, too; a picture
    /// without a raster has no such pixels.
    pub recalled: &'a [&'a Raster<bool>],
    /// Independent, complete sets of samples, by the numbers that seed them.
    pub replicates: Range<u32>,
    /// Samples per pixel of each.
    pub samples: &'a SampleCounts,
    pub seed: u64,
    pub stream: Stream,
}

impl Times<'_> {
    /// The time for a number in [0, 1), in a row of the picture.
    pub fn at(self, part: f64, row: u32, height: u32) -> f64 {
        match self {
            Times::Instant => 0.0,
            Times::Shutter(shutter) => shutter.sample_time(part, row, height),
            Times::Midpoints(shutter, parts) => shutter.subframe_time(part, parts, row, height),
        }
    }
}

/// Computes a result for each of the listed pixels, in their order, on all threads. `work` is the
/// progress that some pixels make.
pub(crate) fn for_each_pixel<T: Send>(
    place: (&Stage, Canvas),
    pixels: &[u32],
    meter: &Meter,
    work: impl Fn(&[u32]) -> u64 + Sync,
    result: impl Fn(&mut Eye, u32) -> T + Sync,
) -> Result<Vec<T>, TraceError> {
    let add = |results: &mut Vec<T>, eye: &mut Eye, pixel| results.push(result(eye, pixel));
    let mut all = Vec::with_capacity(pixels.len());
    for mut results in fill_parts(place, pixels, meter, work, add)? {
        all.append(&mut results);
    }
    Ok(all)
}

/// Adds each of the listed pixels to a part of the result, on all threads; returns the parts in the
/// order of the pixels.
fn fill_parts<P: Default + Send>(
    (stage, canvas): (&Stage, Canvas),
    pixels: &[u32],
    meter: &Meter,
    work: impl Fn(&[u32]) -> u64 + Sync,
    add: impl Fn(&mut P, &mut Eye, u32) + Sync,
) -> Result<Vec<P>, TraceError> {
    let parts = pixels
        .par_chunks(PIXELS_PER_TASK)
        // One at a time: the last of longer runs would keep one thread busy alone.
        .with_max_len(1)
        .map(|task| {
            let mut eye = Eye::new(stage, canvas);
            let mut part = P::default();
            for &pixel in task {
                meter.check()?;
                add(&mut part, &mut eye, pixel);
            }
            meter.advance(work(task));
            Ok(part)
        })
        .collect::<Result<Vec<P>, TraceError>>()?;
    meter.check()?;
    Ok(parts)
}

impl<'a> Film<'a> {
    /// Samples of some pixels over all replicates and pictures, as progress counts them.
    pub fn work(&self, pixels: &[u32]) -> u64 {
        let each = self.replicates.len() as u64 * self.times.len() as u64;
        each * self.samples.sum(pixels)
    }

    /// Renders the listed pixels (indices in row-major order): for every replicate the means of
    /// each picture.
    pub fn render(&self, pixels: &[u32], meter: &Meter) -> Result<Vec<Vec<Means>>, TraceError> {
        let place = (self.integrator.stage, self.canvas);
        let work = |task: &[u32]| self.work(task);
        let pictures = self.times.len();
        let objects = self.integrator.stage.scene.objects.len() + 1;
        let add = |part: &mut Vec<Means>, eye: &mut Eye, pixel: u32| {
            let all = self.replicates.len() * pictures;
            part.resize_with(all, || Means::with_room(PIXELS_PER_TASK, objects));
            let replicates = self.replicates.clone();
            let estimates = replicates.flat_map(|replicate| self.estimate(eye, pixel, replicate));
            for (means, estimate) in part.iter_mut().zip(estimates) {
                means.push(&estimate);
            }
        };
        let parts = fill_parts(place, pixels, meter, work, add)?;
        let join = |at: usize| Means::join(&parts.iter().map(|part| &part[at]).collect::<Vec<_>>());
        Ok((0..self.replicates.len())
            .map(|replicate| replicate * pictures..(replicate + 1) * pictures)
            .map(|pictures| pictures.into_par_iter().map(join).collect())
            .collect())
    }

    /// Renders the listed pixels and turns the estimates of each into a result: for every replicate
    /// one of each picture.
    pub fn summarise<T: Send>(
        &self,
        pixels: &[u32],
        meter: &Meter,
        result: impl Fn(&[Vec<Estimate>]) -> T + Sync,
    ) -> Result<Vec<T>, TraceError> {
        let place = (self.integrator.stage, self.canvas);
        let work = |task: &[u32]| self.work(task);
        for_each_pixel(place, pixels, meter, work, |eye, pixel| {
            let replicates = self.replicates.clone();
            let estimates = replicates.map(|replicate| self.estimate(eye, pixel, replicate));
            result(&estimates.collect::<Vec<Vec<Estimate>>>())
        })
    }

    /// Estimates a pixel of every picture.
    fn estimate(&self, eye: &mut Eye, pixel: u32, replicate: u32) -> Vec<Estimate> {
        let row = pixel / self.canvas.columns();
        let number = self.canvas.seed_number(pixel);
        let seed = pixel_seed(self.seed, self.stream, number, replicate);
        let objects = self.integrator.stage.scene.objects.len() + 1;
        let mut sums: Vec<PixelSums> = (0..self.times.len())
            .map(|picture| PixelSums {
                seen: vec![0.0; objects],
                is_recalled: self.is_recalled(picture, pixel),
                ..PixelSums::default()
            })
            .collect();
        let mut sample = FilmSample::default();
        let samples = self.samples.of(pixel);
        let recalled = if sums.iter().any(|sums| sums.is_recalled) {
            (samples / ONE_RECALLED_IN).max(1)
        } else {
            0
        };
        for index in 0..samples {
            let sampler = Sampler::new(seed, index);
            sample.is_recalled = index < recalled;
            let [x, y, part, _] = sampler.camera();
            let place = match self.color {
                ColorSampling::Antialiased => [x, y],
                ColorSampling::Point => [0.5, 0.5],
            };
            let mut traced_at = None;
            for (times, sums) in self.times.iter().zip(&mut sums) {
                let time = times.at(part, row, self.canvas.height);
                if traced_at != Some(time) {
                    self.trace(eye, pixel, place, time, &sampler, &mut sample);
                    traced_at = Some(time);
                }
                sums.add(&sample);
            }
        }
        let looks_back = self.instant.is_some();
        (sums.into_iter().map(|sums| sums.estimate(looks_back))).collect()
    }

    /// Returns true if the first samples of a pixel of a picture are shaded at the instant, too.
    fn is_recalled(&self, picture: usize, pixel: u32) -> bool {
        (self.recalled.get(picture)).is_some_and(|region| region.pixels[pixel as usize])
    }

    /// Traces one sample of a pixel.
    fn trace(
        &self,
        eye: &mut Eye,
        pixel: u32,
        within: [f64; 2],
        time: f64,
        sampler: &Sampler,
        sample: &mut FilmSample,
    ) {
        let eye_ray = eye.ray_at(time, self.canvas.place(pixel, within), sampler);
        let ray = eye_ray.ray;
        let stage = self.integrator.stage;
        let then = &mut eye.instant;
        sample.clear(self.canvas.place(pixel, [0.5; 2]));
        visit_layers(stage, &mut eye.poses, &ray, |poses, layer| {
            let (radiance, bounces) = self.integrator.follow_path(poses, ray, layer.stop, sampler);
            sample.radiance += layer.weight * radiance;
            sample.bounces += bounces;
            let hit = layer.stop.map(|stop| stop.hit);
            let place = match &self.instant {
                Some(instant) if sample.is_recalled => {
                    let point = instant.look_back(stage, (poses, then), &eye_ray, hit.as_ref());
                    sample.unknowable += layer.share * f64::from(!point.is_shown);
                    if let Some(stop) = layer.stop {
                        let path = (radiance, bounces);
                        let shift =
                            instant.shift(&self.integrator, then, (&point, stop), path, sampler);
                        sample.shift += layer.weight * shift;
                    }
                    point.place
                }
                Some(instant) => instant.find_place(stage, then, &eye_ray, hit.as_ref()),
                None => None,
            };
            sample.seen.push(SeenPoint {
                object_id: hit.map_or(0, |hit| hit.object + 1),
                share: layer.share,
                place,
            });
        });
    }
}

/// One sample of a pixel.
#[derive(Clone, Default)]
struct FilmSample {
    radiance: Vec3,
    /// True if it is also looked up at the instant.
    is_recalled: bool,
    /// Share of it that the frame of the instant does not show.
    unknowable: f64,
    /// Change of the radiance from its own time to the instant.
    shift: Vec3,
    bounces: u32,
    /// All that it saw: more than one point through translucent surfaces.
    seen: Vec<SeenPoint>,
    /// Centre of the pixel.
    centre: [f64; 2],
}

/// A point that a sample saw.
#[derive(Clone)]
struct SeenPoint {
    /// 0 for the background.
    object_id: usize,
    /// Share of the sample.
    share: f64,
    /// Its place at the instant, if it had one and the film looks there.
    place: Option<DVec2>,
}

impl FilmSample {
    /// Empties the sample for another ray.
    fn clear(&mut self, centre: [f64; 2]) {
        self.radiance = Vec3::ZERO;
        self.unknowable = 0.0;
        self.shift = Vec3::ZERO;
        self.bounces = 0;
        self.seen.clear();
        self.centre = centre;
    }
}

/// Sums over the samples of a pixel of one picture.
#[derive(Clone, Default)]
struct PixelSums {
    /// True if the first samples count at the instant, too.
    is_recalled: bool,
    count: u32,
    radiance: DVec3,
    bounces: u32,
    seen: Vec<f64>,
    at_instant: InstantSums,
}

impl PixelSums {
    fn add(&mut self, sample: &FilmSample) {
        self.count += 1;
        self.radiance += sample.radiance.as_dvec3();
        self.bounces += sample.bounces;
        for point in &sample.seen {
            self.seen[point.object_id] += point.share;
            if let Some(place) = point.place {
                (self.at_instant).add_place(place, point.share, sample.centre);
            }
        }
        if self.is_recalled && sample.is_recalled {
            self.at_instant
                .add_recalled(sample.unknowable, sample.shift);
        }
    }

    fn estimate(self, looks_back: bool) -> Estimate {
        let radiance = self.radiance / f64::from(self.count);
        Estimate {
            radiance,
            bounces: f64::from(self.bounces) / f64::from(self.count),
            seen: self.seen,
            at_instant: looks_back.then(|| self.at_instant.means(self.count)),
        }
    }
}
