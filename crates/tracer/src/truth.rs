//! The truth: radiance and visibility integrated over the shutter interval.

use std::ops::Range;
use std::sync::OnceLock;

use frame::{Alignment, AtInstant, ColorSampling, Raster, Replicate, Tile, Truth, motion_margin};
use rayon::prelude::*;
use scene::Scene;

use crate::aligned_shutter::{AlignedShutter, list_family};
use crate::content_hash::{provenance, replicate_hash};
use crate::error::TraceError;
use crate::film::at_instant::{InstantMeans, InstantView};
use crate::film::canvas::Canvas;
use crate::film::finite::{check_at_instant, check_picture};
use crate::film::means::Means;
use crate::film::pilot::{PILOT_REPLICATES, PILOT_SAMPLES, choose_samples};
use crate::film::render::{Film, Times};
use crate::film::sample_counts::SampleCounts;
use crate::film::support::{ProbedSupport, trace_supports};
use crate::path::integrator::Integrator;
use crate::progress::{Meter, Progress, Watch};
use crate::sampler::Stream;
use crate::settings::RenderSettings;
use crate::stage::Stage;

/// A scene prepared to render the replicates of its truths, for one alignment or several.
///
/// Alignments of one exposure overlap. The common part of their intervals is traced once. A
/// replicate has the same bytes whether it is rendered alone or with others.
pub struct TruthTracer<'a> {
    stage: Stage<'a>,
    settings: RenderSettings,
    /// The truths to render.
    shutters: Vec<AlignedShutter>,
    /// All alignments that share their numbers of samples with these.
    family: Vec<AlignedShutter>,
    /// Samples per pixel of a replicate, from the pilot.
    samples: OnceLock<SampleCounts>,
    /// Objects seen per pixel, for each of the truths, probed with the first replicate.
    supports: OnceLock<Vec<ProbedSupport>>,
}

/// Renders the picture that a camera with an open shutter would have taken, and measures its noise.
pub fn trace_truth(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    watch: Watch,
) -> Result<Truth, TraceError> {
    let tracer = TruthTracer::new(scene, settings, &[alignment])?;
    let mut replicates = Vec::new();
    for index in 0..settings.replicates {
        let traced = tracer.trace(index, &|progress: Progress| {
            watch(Progress {
                done: progress.done + u64::from(index) * progress.total,
                total: progress.total * u64::from(settings.replicates),
            })
        })?;
        replicates.extend(traced);
    }
    Ok(Truth::of(&replicates).expect("settings ask for an even number of replicates"))
}

impl<'a> TruthTracer<'a> {
    /// Prepares a scene for one truth per alignment: one alone, or trailing and centred. Refuses
    /// settings with which the scene cannot be rendered.
    pub fn new(
        scene: &'a Scene,
        settings: &RenderSettings,
        alignments: &[Alignment],
    ) -> Result<Self, TraceError> {
        let family = list_family(alignments[0]);
        assert!(
            alignments
                .iter()
                .all(|alignment| family.contains(alignment)),
            "only trailing and centred truths are rendered together"
        );
        let prepare = |alignment: &Alignment| AlignedShutter::new(scene, settings, *alignment);
        let shutters = alignments.iter().map(prepare).collect::<Result<_, _>>()?;
        let family: Vec<AlignedShutter> = family.iter().map(prepare).collect::<Result<_, _>>()?;
        let whole = (family.iter()).map(|shutter| scene.shutter_profile.whole(shutter.shutter));
        let [open, close] = whole.fold([0.0, 0.0], |[open, close]: [f64; 2], whole| {
            [open.min(whole.open), close.max(whole.close)]
        });
        Ok(Self {
            stage: Stage::try_new(scene, open, close)?,
            settings: *settings,
            shutters,
            family,
            samples: OnceLock::new(),
            supports: OnceLock::new(),
        })
    }

    /// Renders one replicate of every truth, in the order of the alignments. The index seeds its
    /// random numbers and changes nothing else; it may exceed the number of replicates in the
    /// settings.
    pub fn trace(&self, index: u32, watch: Watch) -> Result<Vec<Replicate>, TraceError> {
        self.trace_tile(index, self.canvas().whole(), watch)
    }

    /// Renders a tile of one replicate of every truth. The rasters have the tile's size, and the
    /// content of [`TruthTracer::trace`] there. Takes the time of the tile's samples, and of the
    /// whole picture's pilot and support.
    pub fn trace_tile(
        &self,
        index: u32,
        tile: Tile,
        watch: Watch,
    ) -> Result<Vec<Replicate>, TraceError> {
        let pixels = tile.pixels(self.settings.width);
        let samples = self.samples(watch)?;
        let times: Vec<Times> = self.shutters.iter().map(AlignedShutter::times).collect();
        let film = self.film(&times, samples, index..index + 1, Stream::Picture);
        let meter = Meter::new(watch, film.work(&pixels));
        let supports = self.supports(&film, &meter)?;
        let recalled: Vec<&Raster<bool>> = supports.iter().map(|support| &support.shaded).collect();
        let film = Film {
            recalled: &recalled,
            ..film
        };
        let each = film.render(&pixels, &meter)?.remove(0);
        (self.shutters.par_iter().zip(supports).zip(each))
            .map(|((shutter, support), means)| {
                self.replicate((index, tile), shutter, support, means)
            })
            .collect()
    }

    fn canvas(&self) -> Canvas {
        Canvas::bare(self.settings.width, self.settings.height)
    }

    fn film<'f>(
        &'f self,
        times: &'f [Times<'f>],
        samples: &'f SampleCounts,
        replicates: Range<u32>,
        stream: Stream,
    ) -> Film<'f> {
        let canvas = self.canvas();
        Film {
            // Emitters are weighted at the instant, which belongs to every alignment.
            integrator: Integrator::new(&self.stage, 0.0),
            canvas,
            color: ColorSampling::Antialiased,
            times,
            instant: Some(InstantView::new(&self.stage, canvas)),
            recalled: &[],
            replicates,
            samples,
            seed: self.settings.seed,
            stream,
        }
    }

    /// Assembles a tile of a replicate from its pixels in row-major order.
    fn replicate(
        &self,
        (index, tile): (u32, Tile),
        shutter: &AlignedShutter,
        support: &ProbedSupport,
        mut means: Means,
    ) -> Result<Replicate, TraceError> {
        let scene = self.stage.scene;
        let canvas = self.canvas();
        let settings = &self.settings;
        let at_instant = assemble_at_instant(tile, std::mem::take(&mut means.at_instant))
            .rounded()
            .within(&support.moving.part(tile));
        let picture = means.into_picture(tile);
        check_picture(scene, &picture)?;
        check_at_instant(scene, &at_instant)?;
        let samples = self.samples.get().expect("the replicate was traced by it");
        Ok(Replicate {
            provenance: provenance(
                &self.stage,
                settings.seed,
                settings.samples_per_replicate(),
                1,
                replicate_hash(scene, settings, shutter.alignment),
            ),
            index,
            shutter: shutter.shutter,
            shutter_profile: scene.shutter_profile.clone(),
            alignment: shutter.alignment,
            objects: scene.object_names(),
            moving: shutter.moving.clone(),
            picture,
            at_instant,
            samples: samples.to_plane(canvas).part(tile),
            support: support.support.part(tile),
        })
    }

    /// The samples of every pixel, which are the same for every replicate and every alignment of
    /// the family.
    fn samples(&self, watch: Watch) -> Result<&SampleCounts, TraceError> {
        get_or_try_init(&self.samples, || self.samples_on(self.canvas(), watch))
    }

    /// Chooses the samples of every pixel of a canvas in a replicate: a truth's, or those of the
    /// frame that goes with it.
    pub(crate) fn samples_on(
        &self,
        canvas: Canvas,
        watch: Watch,
    ) -> Result<SampleCounts, TraceError> {
        let times: Vec<Times> = self.family.iter().map(AlignedShutter::times).collect();
        let uniform = SampleCounts::Uniform(PILOT_SAMPLES);
        let pilot = Film {
            canvas,
            instant: None,
            ..self.film(&times, &uniform, 0..PILOT_REPLICATES, Stream::Pilot)
        };
        let moving: Vec<bool> = (0..self.stage.scene.objects.len() + 1)
            .map(|object| self.family.iter().any(|shutter| shutter.moving[object]))
            .collect();
        let mean = self.settings.samples_per_replicate();
        let margin = motion_margin(self.settings.height);
        choose_samples(&pilot, &moving, margin, mean, watch)
    }

    /// The scene over the shutters of the family.
    pub(crate) fn stage(&self) -> &Stage<'a> {
        &self.stage
    }

    /// The supports of all truths, which are the same for every replicate.
    fn supports(&self, film: &Film, meter: &Meter) -> Result<&[ProbedSupport], TraceError> {
        let supports = get_or_try_init(&self.supports, || {
            let shutters = self.shutters.iter();
            let moving: Vec<&[bool]> = shutters.map(|shutter| &shutter.moving[..]).collect();
            trace_supports(film, &moving, meter)
        })?;
        Ok(supports)
    }
}

/// Returns the content of a cell; fills it first if it is empty. Another thread may be faster, with
/// the same result.
fn get_or_try_init<T>(
    cell: &OnceLock<T>,
    make: impl FnOnce() -> Result<T, TraceError>,
) -> Result<&T, TraceError> {
    match cell.get() {
        Some(content) => Ok(content),
        None => {
            let made = make()?;
            Ok(cell.get_or_init(|| made))
        }
    }
}

/// Assembles the layers of the instant from their pixels in row-major order.
fn assemble_at_instant(tile: Tile, pixels: Vec<InstantMeans>) -> AtInstant {
    let pixels: Raster<InstantMeans> = Raster {
        width: tile.width,
        height: tile.height,
        pixels,
    };
    AtInstant {
        shift: pixels.map(|pixel| pixel.shift.as_vec3().to_array()),
        unknowable: pixels.map(|pixel| pixel.unknowable as f32),
        placed: pixels.map(|pixel| pixel.placed as f32),
        offset: pixels.map(|pixel| pixel.offset.as_vec2().to_array()),
        spread: pixels.map(|pixel| pixel.spread.as_vec2().to_array()),
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use scene::Background;

    use crate::test_scene::load_test_scene;

    use super::*;

    fn unwatched(_: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn small_settings() -> RenderSettings {
        RenderSettings {
            width: 48,
            height: 27,
            samples_per_pixel: 32,
            replicates: 2,
            ..RenderSettings::default()
        }
    }

    #[test]
    fn every_instruction_set_renders_the_same_bytes() {
        for scene in ["two_spheres", "fan", "glasshouse"] {
            let scene = load_test_scene(scene);
            let settings = small_settings();
            let mut tracer = TruthTracer::new(&scene, &settings, &[Alignment::Trailing])
                .expect("settings are allowed");
            let trace = |tracer: &TruthTracer| {
                let mut traced = tracer.trace(0, &unwatched).expect("nothing cancels");
                traced.remove(0)
            };
            let fastest = trace(&tracer);
            tracer.stage = tracer.stage.portable();
            assert_eq!(tracer.stage.traversal(), "portable");
            let portable = trace(&tracer);
            assert_eq!(fastest.picture.color.pixels, portable.picture.color.pixels);
        }
    }

    #[test]
    fn a_replicate_has_the_same_bytes_alone_and_with_the_other_alignment() {
        for scene in ["fan", "railing"] {
            let scene = load_test_scene(scene);
            let settings = RenderSettings {
                exposure: Some(0.3),
                ..small_settings()
            };
            let trace = |alignments: &[Alignment]| {
                let tracer = TruthTracer::new(&scene, &settings, alignments).expect("allowed");
                tracer.trace(1, &unwatched).expect("nothing cancels")
            };
            let [trailing, centred] = [Alignment::Trailing, Alignment::Centred];
            let both = trace(&[trailing, centred]);
            assert_eq!(both, [trace(&[trailing]), trace(&[centred])].concat());
            assert_ne!(both[0].picture, both[1].picture);
        }
    }

    #[test]
    fn samples_gather_where_the_picture_is_noisy_and_do_not_exceed_the_mean() {
        let scene = load_test_scene("two_spheres");
        let settings = RenderSettings {
            width: 64,
            height: 36,
            samples_per_pixel: 64,
            ..small_settings()
        };
        let truth = trace_truth(&scene, &settings, Alignment::Trailing, &unwatched)
            .expect("settings are allowed");
        let samples = &truth.samples.pixels;
        let mean = samples.iter().sum::<f32>() / samples.len() as f32;
        assert!((32.0..=64.0).contains(&mean), "{mean}");
        let errors = truth.standard_error.pixels.iter();
        let noise: Vec<f32> = errors.map(|error| error.iter().sum()).collect();
        let mean_noise = |wanted: fn(f32) -> bool| {
            let wanted = samples
                .iter()
                .zip(&noise)
                .filter(|(count, _)| wanted(**count));
            let noise: Vec<f32> = wanted.map(|(_, noise)| *noise).collect();
            noise.iter().sum::<f32>() / noise.len() as f32
        };
        let [few, many] = [
            mean_noise(|count| count <= 16.0),
            mean_noise(|count| count > 64.0),
        ];
        assert!(few < many, "{few} {many}");
    }

    /// Renders two replicates of a scene at four by four pixels.
    fn trace_small(change: impl FnOnce(&mut Scene)) -> Result<Truth, TraceError> {
        let mut scene = load_test_scene("two_spheres");
        change(&mut scene);
        let settings = RenderSettings {
            width: 4,
            height: 4,
            samples_per_pixel: 4,
            ..small_settings()
        };
        trace_truth(&scene, &settings, Alignment::Trailing, &unwatched)
    }

    #[test]
    fn a_pixel_that_is_not_finite_is_refused_by_layer_and_place() {
        for radiance in [f32::INFINITY, f32::NAN, f32::MAX] {
            let result = trace_small(|scene| {
                scene.background = Background::Constant(glam::Vec3::splat(radiance));
            });
            let Err(TraceError::NotFinite { layer, x, y, .. }) = result else {
                panic!("{radiance} went into a truth");
            };
            assert_eq!((layer.as_str(), x, y), ("color", 0, 0));
        }
    }

    #[test]
    fn an_object_too_far_away_is_refused_by_name() {
        for far in [1e16, f64::INFINITY, f64::NAN] {
            let result = trace_small(|scene| {
                for key in &mut scene.objects[1].motion.keys {
                    key.translation.x = far;
                }
            });
            let Err(TraceError::TooFar { object, .. }) = result else {
                panic!("{far} m is allowed");
            };
            assert!(!object.is_empty());
        }
    }
}
