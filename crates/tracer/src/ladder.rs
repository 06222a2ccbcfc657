//! Ladders: accumulations of a few sub-frames, for comparison with the truth of the same shutter.

use frame::{
    Accumulation, Alignment, ColorSampling, Ladder, Picture, Plane, Raster, Shutter, Tile, Truth,
    motion_margin,
};

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
use crate::scene::Scene;
use crate::settings::RenderSettings;
use crate::stage::Stage;

/// One replicate per half; more would only stratify worse.
const REPLICATES: u32 = 2;
/// Part of a sample's cost that is saved if it sees the background (measured: about 0.2 against 1.6 microseconds for
/// lit surfaces).
const SAVED_BY_A_MISS: f64 = 0.875;

/// A scene prepared to render the rungs of a ladder, one at a time: all together take more memory than the truth.
///
/// Only pixels near motion are rendered, because an accumulation can differ from the truth only there. Elsewhere both halves
/// have the truth's mean, even in a moving shadow on a still floor that is far from anything that moves.
///
/// All rungs have the same number of samples, the most with which they together cost no more than the truth, in samples and
/// in work. Their random numbers are their own, so that their noise is independent of the truth's.
pub struct LadderTracer<'a> {
    stage: Stage<'a>,
    seed: u64,
    shutter: Shutter,
    alignment: Alignment,
    /// Mean of the truth.
    mean: Picture,
    /// Indices of the pixels that are rendered.
    pixels: Vec<u32>,
    samples_per_replicate: u32,
    hash: String,
}

impl<'a> LadderTracer<'a> {
    /// Prepares the ladder of these numbers of `subframes` over the shutter of `truth`, which was rendered with `settings`.
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
            (settings.width, settings.height),
            "the truth was rendered with the ladder's settings"
        );
        let whole = scene.shutter_profile.whole(shutter);
        let pixels = pixels_near_motion(&truth.support.moving, motion_margin(settings.height));
        let mean = truth.mean();
        Ok(Self {
            stage: Stage::try_new(scene, whole.open, whole.close)?,
            seed: settings.seed,
            shutter,
            alignment: truth.alignment,
            samples_per_replicate: affordable_samples(
                settings,
                &mean.coverage[0],
                &pixels,
                subframes.len(),
            ),
            mean,
            pixels,
            hash: ladder_hash(scene, settings, truth.alignment, subframes),
        })
    }

    /// Renders the rung of a number of sub-frames, as a ladder of it alone. It does not depend on the other rungs.
    pub fn trace(&self, subframes: u32, watch: Watch) -> Result<Ladder, TraceError> {
        let whole = Tile::whole(self.mean.color.width, self.mean.color.height);
        self.trace_tile(subframes, whole, watch)
    }

    /// Renders a tile of that rung. The rasters have the tile's size, and the content of [`LadderTracer::trace`] there.
    pub fn trace_tile(
        &self,
        subframes: u32,
        tile: Tile,
        watch: Watch,
    ) -> Result<Ladder, TraceError> {
        let (width, height) = (self.mean.color.width, self.mean.color.height);
        // Each pixel that is rendered, and its place in the tile.
        let (pixels, places): (Vec<u32>, Vec<usize>) = (self.pixels.iter())
            .filter_map(|&pixel| Some((pixel, tile.index_of(pixel, width)?)))
            .unzip();
        let samples_per_pixel = REPLICATES * self.samples_per_replicate;
        let work = pixels.len() as u64 * u64::from(samples_per_pixel);
        let shutter_sampler = ShutterSampler::new(self.shutter, &self.stage.scene.shutter_profile);
        let film = Film {
            integrator: Integrator::new(&self.stage, 0.0),
            canvas: Canvas::bare(width, height),
            color: ColorSampling::Antialiased,
            times: &[Times::Midpoints(&shutter_sampler, subframes)],
            instant: None,
            recalled: &[],
            replicates: 0..REPLICATES,
            samples: &SampleCounts::Uniform(self.samples_per_replicate),
            seed: self.seed,
            stream: Stream::Accumulation(subframes),
        };
        let rendered = film.render(&pixels, &Meter::new(watch, work))?;
        let halves = [0, 1].map(|half| {
            let mut picture = self.mean.part(tile);
            set_pixels(&mut picture, &places, &rendered[half][0]);
            picture
        });
        for half in &halves {
            check_picture(self.stage.scene, half)?;
        }
        Ok(Ladder {
            provenance: provenance(
                &self.stage,
                self.seed,
                samples_per_pixel,
                REPLICATES,
                self.hash.clone(),
            ),
            shutter: self.shutter,
            shutter_profile: self.stage.scene.shutter_profile.clone(),
            alignment: self.alignment,
            objects: self.stage.scene.object_names(),
            rungs: vec![Accumulation { subframes, halves }],
        })
    }
}

/// Renders one accumulation per number of `subframes`, over the shutter of `truth`, which was rendered with `settings`, as
/// [`LadderTracer`] does.
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

/// Replaces the pixels at some places.
fn set_pixels(picture: &mut Picture, places: &[usize], means: &Means) {
    for (&place, color) in places.iter().zip(&means.color) {
        picture.color.pixels[place] = *color;
    }
    for (plane, coverage) in picture.coverage.iter_mut().zip(&means.coverage) {
        for (&place, coverage) in places.iter().zip(coverage) {
            plane.pixels[place] = *coverage;
        }
    }
}

/// The samples per replicate: the largest power of two with which all rungs together take no more samples and no more work
/// than the truth, and no rung has more samples per pixel than it; at least one.
fn affordable_samples(
    settings: &RenderSettings,
    background: &Plane,
    pixels: &[u32],
    rungs: usize,
) -> u32 {
    let work = |pixel: &f32| 1.0 - SAVED_BY_A_MISS * f64::from(*pixel);
    let work_of_truth: f64 = background.pixels.iter().map(work).sum();
    let work_of_rung: f64 = pixels
        .iter()
        .map(|&pixel| work(&background.pixels[pixel as usize]))
        .sum();
    let pixel_ratio = background.pixels.len() as f64 / pixels.len().max(1) as f64;
    let work_ratio = work_of_truth / work_of_rung.max(f64::MIN_POSITIVE);
    let per_rung = pixel_ratio.min(work_ratio) / rungs as f64;
    let most = f64::from(settings.samples_per_pixel / REPLICATES) * per_rung.min(1.0);
    let most = (most as u32).clamp(1, MAX_SAMPLES);
    1 << most.ilog2()
}

/// Indices of the pixels within the margin of any pixel that shows motion, rising.
fn pixels_near_motion(motion: &Raster<bool>, margin: u32) -> Vec<u32> {
    let near = dilate_square(motion, margin);
    (0..motion.width * motion.height)
        .filter(|&pixel| near.pixels[pixel as usize])
        .collect()
}
