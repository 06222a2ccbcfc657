//! The truth: radiance and visibility integrated over the shutter interval.

use std::sync::OnceLock;

use frame::{AtInstant, Raster, Replicate, Shutter, Support, Truth};

use crate::content_hash::{provenance, replicate_hash};
use crate::error::TraceError;
use crate::film::at_instant::{InstantMeans, InstantView};
use crate::film::canvas::Canvas;
use crate::film::finite::{check_at_instant, check_picture};
use crate::film::render::{Film, PixelMean, Places, Times, assemble_picture};
use crate::film::sampler::Stream;
use crate::film::shutter_sampler::ShutterSampler;
use crate::film::support::trace_support;
use crate::light::integrator::Integrator;
use crate::motion::moving::find_moving_objects;
use crate::progress::{Meter, Progress, Watch};
use crate::scene::Scene;
use crate::settings::TruthSettings;
use crate::stage::Stage;

/// A scene prepared to render the replicates of one truth.
pub struct TruthTracer<'a> {
    stage: Stage<'a>,
    settings: TruthSettings,
    shutter: Shutter,
    shutter_sampler: ShutterSampler,
    moving: Vec<bool>,
    /// Objects seen per pixel, probed with the first replicate.
    support: OnceLock<Support>,
}

/// Renders the picture that a camera with an open shutter would have taken, and measures its noise.
pub fn trace_truth(
    scene: &Scene,
    settings: &TruthSettings,
    watch: Watch,
) -> Result<Truth, TraceError> {
    let tracer = TruthTracer::new(scene, settings)?;
    let replicates: Vec<Replicate> = (0..settings.replicates)
        .map(|index| {
            tracer.trace(index, &|progress: Progress| {
                watch(Progress {
                    done: progress.done + u64::from(index) * progress.total,
                    total: progress.total * u64::from(settings.replicates),
                })
            })
        })
        .collect::<Result<_, _>>()?;
    Ok(Truth::of(&replicates).expect("settings ask for an even number of replicates"))
}

impl<'a> TruthTracer<'a> {
    /// Prepares a scene; refuses settings with which it cannot be rendered.
    pub fn new(scene: &'a Scene, settings: &TruthSettings) -> Result<Self, TraceError> {
        let shutter = settings.check(scene)?;
        let whole = scene.shutter_profile.whole(shutter);
        Ok(Self {
            stage: Stage::try_new(scene, whole.open.min(0.0), whole.close.max(0.0))?,
            settings: *settings,
            shutter,
            shutter_sampler: ShutterSampler::new(shutter, &scene.shutter_profile),
            moving: find_moving_objects(scene, whole),
            support: OnceLock::new(),
        })
    }

    /// Memory that a pixel takes while a replicate is traced, in bytes: its means, those at the instant, and the support.
    pub fn bytes_per_pixel(&self) -> usize {
        let coverages = self.stage.scene.objects.len() + 1;
        let masks = coverages + 2;
        size_of::<PixelMean>()
            + coverages * size_of::<f32>()
            + size_of::<InstantMeans>()
            + masks * size_of::<bool>()
    }

    /// Renders one replicate. The index seeds its random numbers and changes nothing else; it may exceed the number of
    /// replicates in the settings.
    pub fn trace(&self, index: u32, watch: Watch) -> Result<Replicate, TraceError> {
        let canvas = Canvas::bare(self.settings.width, self.settings.height);
        let film = Film {
            integrator: Integrator::new(&self.stage, self.shutter.at(0.5)),
            canvas,
            places: Places::Area,
            times: Times::Shutter(&self.shutter_sampler),
            instant: Some(InstantView::new(&self.stage, canvas)),
            replicates: index..index + 1,
            samples_per_replicate: self.settings.samples_per_replicate(),
            seed: self.settings.seed,
            stream: Stream::Truth,
        };
        let pixels = canvas.pixels();
        let meter = Meter::new(watch, pixels.len() as u64 * film.samples_per_pixel());
        let support = self.support(&film, &meter)?;
        let rendered = film.render(&pixels, &meter, |estimates| {
            (PixelMean::of(estimates), estimates[0].at_instant)
        })?;
        let (means, instant_means): (Vec<PixelMean>, Vec<InstantMeans>) =
            rendered.into_iter().unzip();
        let scene = self.stage.scene;
        let picture = assemble_picture(canvas, &means);
        let at_instant = assemble_at_instant(canvas, instant_means);
        check_picture(scene, &picture)?;
        check_at_instant(scene, &at_instant)?;
        Ok(Replicate {
            provenance: provenance(
                &self.stage,
                self.settings.seed,
                self.settings.samples_per_replicate(),
                1,
                replicate_hash(scene, &self.settings),
            ),
            index,
            shutter: self.shutter,
            shutter_profile: scene.shutter_profile.clone(),
            alignment: self.settings.alignment,
            objects: scene.object_names(),
            moving: self.moving.clone(),
            picture,
            at_instant,
            support,
        })
    }

    /// The support, which is the same for every replicate.
    fn support(&self, film: &Film, meter: &Meter) -> Result<Support, TraceError> {
        if self.support.get().is_none() {
            let found = trace_support(film, &self.moving, meter)?;
            // Another thread may have been faster, with the same result.
            self.support.get_or_init(|| found);
        }
        Ok(self.support.get().expect("it was just probed").clone())
    }
}

/// Assembles the layers of the instant from their pixels in row-major order.
fn assemble_at_instant(canvas: Canvas, pixels: Vec<InstantMeans>) -> AtInstant {
    let pixels: Raster<InstantMeans> = Raster {
        width: canvas.width,
        height: canvas.height,
        pixels,
    };
    AtInstant {
        frozen: pixels.map(|pixel| pixel.frozen.as_vec3().to_array()),
        unknowable: pixels.map(|pixel| pixel.unknowable as f32),
        placed: pixels.map(|pixel| pixel.placed as f32),
        offset: pixels.map(|pixel| pixel.offset.as_vec2().to_array()),
        spread: pixels.map(|pixel| pixel.spread.as_vec3().to_array()),
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use crate::scene::Background;
    use crate::test_scene::load_test_scene;

    use super::*;

    #[test]
    fn every_instruction_set_renders_the_same_bytes() {
        for scene in ["two_spheres", "fan"] {
            let scene = load_test_scene(scene);
            let settings = TruthSettings {
                width: 48,
                height: 27,
                samples_per_pixel: 32,
                replicates: 2,
                ..TruthSettings::default()
            };
            let mut tracer = TruthTracer::new(&scene, &settings).expect("settings are allowed");
            let unwatched = |_: Progress| ControlFlow::Continue(());
            let fastest = tracer.trace(0, &unwatched).expect("nothing cancels");
            tracer.stage = tracer.stage.portable();
            assert_eq!(tracer.stage.traversal(), "portable");
            let portable = tracer.trace(0, &unwatched).expect("nothing cancels");
            assert_eq!(fastest.picture.color.pixels, portable.picture.color.pixels);
        }
    }

    /// Renders two replicates of a scene at four by four pixels.
    fn trace_small(change: impl FnOnce(&mut Scene)) -> Result<Truth, TraceError> {
        let mut scene = load_test_scene("two_spheres");
        change(&mut scene);
        let settings = TruthSettings {
            width: 4,
            height: 4,
            samples_per_pixel: 4,
            replicates: 2,
            ..TruthSettings::default()
        };
        trace_truth(&scene, &settings, &|_| ControlFlow::Continue(()))
    }

    #[test]
    fn a_pixel_that_is_not_finite_is_refused_by_layer_and_place() {
        for radiance in [f32::INFINITY, f32::NAN, f32::MAX] {
            let found = trace_small(|scene| {
                scene.background = Background::Constant(glam::Vec3::splat(radiance));
            });
            let Err(TraceError::NotFinite { layer, x, y, .. }) = found else {
                panic!("{radiance} went into a truth");
            };
            assert_eq!((layer.as_str(), x, y), ("color", 0, 0));
        }
    }

    #[test]
    fn an_object_too_far_away_is_refused_by_name() {
        for far in [1e16, f64::INFINITY, f64::NAN] {
            let found = trace_small(|scene| {
                for key in &mut scene.objects[1].motion.keys {
                    key.translation.x = far;
                }
            });
            let Err(TraceError::TooFar { object, .. }) = found else {
                panic!("{far} m is allowed");
            };
            assert!(!object.is_empty());
        }
    }
}
