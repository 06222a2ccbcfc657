//! Ladders: accumulations of a few sub-frames, for comparison with the truth of the same shutter.

use std::sync::OnceLock;

use frame::{
    Accumulation, Alignment, ColorSampling, Image, Ladder, MOST_GROUPS, Picture, Plane, Raster,
    Shutter, Size, Tile, Truth, motion_margin,
};
use scene::Scene;

use crate::content_hash::{ladder_hash, provenance};
use crate::error::TraceError;
use crate::film::canvas::Canvas;
use crate::film::dilate::dilate_square;
use crate::film::finite::check_picture;
use crate::film::means::Means;
use crate::film::render::{Film, Times};
use crate::film::sample_counts::SampleCounts;
use crate::film::shutter_sampler::ShutterSampler;
use crate::limits::MAX_SAMPLES;
use crate::path::integrator::Integrator;
use crate::progress::{Meter, Progress, Watch};
use crate::sampler::Stream;
use crate::settings::RenderSettings;
use crate::stage::Stage;

/// Fewest groups of samples: two make an unbiased squared error.
const FEWEST_GROUPS: u32 = 2;
/// Samples of a pixel in which nothing moves, but only light may change, relative to others.
const SHARE_OF_MARGIN: f64 = 0.25;
/// Part of a sample's cost that is saved if it sees the background (measured: about 0.2 against 1.6
/// microseconds for lit surfaces).
const SAVED_BY_A_MISS: f64 = 0.875;

/// A scene prepared to render the rungs of a ladder, one at a time: all together take more memory
/// than the truth.
///
/// A rung is the difference of two pictures with the same random numbers: the sub-frames' and the
/// whole shutter's. Each sample of the whole shutter has a partner at the middle of the sub-frame
/// that it falls into, so that the two see nearly the same if sub-frames are many. All rungs share
/// these random numbers, which are independent of the truth's.
///
/// Only pixels near motion are rendered, because an accumulation can differ from the truth only
/// there. Elsewhere differences are 0, even in a moving shadow on a still floor that is far from
/// anything that moves.
///
/// A pixel's samples are in proportion to the truth's, and as many in all rungs: the most with
/// which all rungs together cost no more than the truth, but no more than the truth's own.
pub struct LadderTracer<'a> {
    stage: Stage<'a>,
    seed: u64,
    alignment: Alignment,
    shutter: Shutter,
    sampler: ShutterSampler,
    /// Size of the picture.
    size: Size,
    /// Indices of the pixels that are rendered.
    pixels: Vec<u32>,
    /// Independent groups of samples: one per pair of the truth's replicates.
    groups: u32,
    /// Samples per pixel of a group.
    samples: SampleCounts,
    /// Means of the whole shutter over all rendered pixels, per group: traced for the first rung.
    whole: OnceLock<Vec<Means>>,
    hash: String,
}

impl<'a> LadderTracer<'a> {
    /// Prepares the ladder of these numbers of `subframes` over the shutter of `truth`, which was
    /// rendered with `settings`.
    pub fn new(
        scene: &'a Scene,
        settings: &RenderSettings,
        truth: &Truth,
        subframes: &[u32],
    ) -> Result<Self, TraceError> {
        let shutter = settings.check_truth(scene, truth.alignment)?;
        check_subframes(subframes)?;
        assert_eq!(
            truth.size(),
            settings.size(),
            "the truth was rendered with the ladder's settings"
        );
        let whole = scene.shutter_profile.whole(shutter);
        let pixels = pixels_near_motion(&truth.support.moving, motion_margin(settings.height));
        let groups = (settings.replicates / 2).clamp(FEWEST_GROUPS, MOST_GROUPS);
        Ok(Self {
            stage: Stage::try_new(scene, whole.open, whole.close)?,
            seed: settings.seed,
            alignment: truth.alignment,
            shutter,
            sampler: ShutterSampler::new(shutter, &scene.shutter_profile),
            size: truth.size(),
            samples: share_samples(truth, &pixels, groups, subframes.len()),
            groups,
            pixels,
            whole: OnceLock::new(),
            hash: ladder_hash(scene, settings, truth.alignment, subframes),
        })
    }

    /// Renders the rung of a number of sub-frames, as a ladder of it alone. It does not depend on
    /// the other rungs. The first rung also renders the whole shutter, which takes as long as a
    /// rung.
    pub fn trace(&self, subframes: u32, watch: Watch) -> Result<Ladder, TraceError> {
        let Size { width, height } = self.size;
        let pixels = &self.pixels;
        let pictures = if self.whole.get().is_none() { 2 } else { 1 };
        let part = |index: u64| {
            move |progress: Progress| {
                watch(Progress {
                    done: progress.done + index * progress.total,
                    total: pictures * progress.total,
                })
            }
        };
        let whole = match self.whole.get() {
            Some(whole) => whole,
            None => {
                let made = self.render(pixels, Times::Shutter(&self.sampler), &part(0))?;
                self.whole.get_or_init(|| made)
            }
        };
        let times = Times::Midpoints(&self.sampler, subframes);
        let parts = self.render(pixels, times, &part(pictures - 1))?;
        let places: Vec<usize> = pixels.iter().map(|&pixel| pixel as usize).collect();
        self.rung(
            subframes,
            Tile::whole(width, height),
            &places,
            [whole, &parts],
        )
    }

    /// Renders a tile of that rung. The rasters have the tile's size, and the content of
    /// [`LadderTracer::trace`] there.
    pub fn trace_tile(
        &self,
        subframes: u32,
        tile: Tile,
        watch: Watch,
    ) -> Result<Ladder, TraceError> {
        // Each pixel that is rendered, and its place in the tile.
        let (pixels, places): (Vec<u32>, Vec<usize>) = (self.pixels.iter())
            .filter_map(|&pixel| Some((pixel, tile.index_of(pixel, self.size.width)?)))
            .unzip();
        let whole = self.render(&pixels, Times::Shutter(&self.sampler), watch)?;
        let parts = self.render(&pixels, Times::Midpoints(&self.sampler, subframes), watch)?;
        self.rung(subframes, tile, &places, [&whole, &parts])
    }

    /// Renders some pixels at some times: their means in each group.
    fn render(&self, pixels: &[u32], times: Times, watch: Watch) -> Result<Vec<Means>, TraceError> {
        let film = Film {
            integrator: Integrator::new(&self.stage, 0.0),
            canvas: Canvas::bare(self.size.width, self.size.height),
            color: ColorSampling::Antialiased,
            times: &[times],
            instant: None,
            recalled: &[],
            replicates: 0..self.groups,
            samples: &self.samples,
            seed: self.seed,
            stream: Stream::Ladder,
        };
        let rendered = film.render(pixels, &Meter::new(watch, film.work(pixels)))?;
        Ok(rendered.into_iter().flatten().collect())
    }

    /// Assembles a tile of a rung from the means at some places of it.
    fn rung(
        &self,
        subframes: u32,
        tile: Tile,
        places: &[usize],
        [whole, parts]: [&[Means]; 2],
    ) -> Result<Ladder, TraceError> {
        let scene = self.stage.scene;
        let groups = whole.iter().zip(parts);
        let groups: Vec<Picture> = groups
            .map(|(whole, parts)| {
                let objects = scene.objects.len() + 1;
                subtract((tile, objects), places, [parts, whole])
            })
            .collect();
        for group in &groups {
            check_picture(scene, group)?;
        }
        let samples = u64::from(self.groups) * self.samples.sum(&self.pixels);
        let mean_samples = samples / (self.pixels.len() as u64).max(1);
        Ok(Ladder {
            provenance: provenance(
                &self.stage,
                self.seed,
                mean_samples as u32,
                self.groups,
                self.hash.clone(),
            ),
            shutter: self.shutter,
            shutter_profile: scene.shutter_profile.clone(),
            alignment: self.alignment,
            objects: scene.object_names(),
            rungs: vec![Accumulation { subframes, groups }],
        })
    }
}

/// Renders one accumulation per number of `subframes`, over the shutter of `truth`, which was
/// rendered with `settings`, as [`LadderTracer`] does.
pub fn trace_ladder(
    scene: &Scene,
    settings: &RenderSettings,
    truth: &Truth,
    subframes: &[u32],
    watch: Watch,
) -> Result<Ladder, TraceError> {
    let tracer = LadderTracer::new(scene, settings, truth, subframes)?;
    let mut ladder: Option<Ladder> = None;
    for (index, count) in (0..).zip(subframes) {
        let rung = tracer.trace(*count, &|progress: Progress| {
            watch(Progress {
                done: progress.done + index * progress.total,
                total: progress.total * subframes.len() as u64,
            })
        })?;
        match &mut ladder {
            None => ladder = Some(rung),
            Some(ladder) => ladder.rungs.extend(rung.rungs),
        }
    }
    Ok(ladder.expect("an empty list of sub-frames was refused"))
}

fn check_subframes(subframes: &[u32]) -> Result<(), TraceError> {
    let rising = subframes.windows(2).all(|pair| pair[0] < pair[1]);
    match subframes.first() {
        Some(1..) if rising => Ok(()),
        _ => Err(TraceError::Subframes(subframes.to_vec())),
    }
}

/// Shares out the samples of each group as [`LadderTracer`] says: powers of two, at least one.
fn share_samples(truth: &Truth, pixels: &[u32], groups: u32, rungs: usize) -> SampleCounts {
    let background = &truth.mean().coverage[0];
    let work = |pixel: usize, samples: f64| {
        samples * (1.0 - SAVED_BY_A_MISS * f64::from(background.pixels[pixel]))
    };
    let of_truth = |pixel: usize| f64::from(truth.samples.pixels[pixel]);
    // Samples of a rung with as many as the truth where anything moves.
    let of_rung = |pixel: usize| {
        let share = if truth.support.moving.pixels[pixel] {
            1.0
        } else {
            SHARE_OF_MARGIN
        };
        share * of_truth(pixel)
    };
    let all = 0..truth.samples.pixels.len();
    let work_of_truth: f64 = all.clone().map(|pixel| work(pixel, of_truth(pixel))).sum();
    let rendered = pixels.iter().map(|&pixel| pixel as usize);
    let work_of_rung: f64 = rendered.map(|pixel| work(pixel, of_rung(pixel))).sum();
    // The whole shutter costs as much as a rung.
    let work_of_ladder = (rungs + 1) as f64 * work_of_rung.max(f64::MIN_POSITIVE);
    let part = (work_of_truth / work_of_ladder).min(1.0) / f64::from(groups);
    let counts = all.map(|pixel| {
        let samples = (part * of_rung(pixel)).clamp(1.0, f64::from(MAX_SAMPLES));
        1 << (samples.log2().round() as u32)
    });
    SampleCounts::PerPixel(counts.collect())
}

/// Subtracts the whole shutter's means from those of sub-frames; other places of the tile hold 0.
/// Without places there are no means of objects, either.
fn subtract(
    (tile, objects): (Tile, usize),
    places: &[usize],
    [parts, whole]: [&Means; 2],
) -> Picture {
    let Tile { width, height, .. } = tile;
    let mut color: Image = Raster::filled(width, height, [0.0; 3]);
    let colors = parts.color.iter().zip(&whole.color);
    for (&place, (parts, whole)) in places.iter().zip(colors) {
        color.pixels[place] = std::array::from_fn(|c| parts[c] - whole[c]);
    }
    let mut coverage: Vec<Plane> = vec![Raster::filled(width, height, 0.0); objects];
    let coverages = parts.coverage.iter().zip(&whole.coverage);
    for (plane, (parts, whole)) in coverage.iter_mut().zip(coverages) {
        for (&place, (parts, whole)) in places.iter().zip(parts.iter().zip(whole)) {
            plane.pixels[place] = parts - whole;
        }
    }
    Picture { coverage, color }
}

/// Indices of the pixels within the margin of any pixel that shows motion, rising.
fn pixels_near_motion(motion: &Raster<bool>, margin: u32) -> Vec<u32> {
    let near = dilate_square(motion, margin);
    (0..motion.width * motion.height)
        .filter(|&pixel| near.pixels[pixel as usize])
        .collect()
}
