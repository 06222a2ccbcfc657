//! The truth: radiance and visibility integrated over the shutter.

use frame::{Image, Picture, Plane, Truth};
use glam::DVec3;

use crate::film::{Film, PixelMean, Replicate, Times, picture};
use crate::moving::moving_objects;
use crate::path::Integrator;
use crate::progress::{Meter, Watch};
use crate::provenance::{object_names, provenance, truth_hash};
use crate::sampler::Stream;
use crate::scene::Scene;
use crate::settings::{TraceError, TruthSettings};
use crate::stage::Stage;

/// One pixel of both halves, and the spread between all replicates.
struct TruthPixel {
    halves: [PixelMean; 2],
    standard_error: [f32; 3],
}

/// Renders what a camera with an open shutter would have seen, with its own noise.
pub fn trace_truth(
    scene: &Scene,
    settings: &TruthSettings,
    watch: Watch,
) -> Result<Truth, TraceError> {
    let shutter = settings.check(scene)?;
    let (width, height) = (settings.width, settings.height);
    let stage = Stage::new(scene, shutter.open, shutter.close);
    let film = Film {
        integrator: Integrator::new(&stage, shutter.at(0.5)),
        width,
        height,
        times: Times::Open(shutter),
        replicates: settings.replicates,
        samples_per_replicate: settings.samples_per_pixel / settings.replicates,
        seed: settings.seed,
        stream: Stream::Truth,
    };
    let pixels: Vec<u32> = (0..width * height).collect();
    let meter = Meter::new(watch, pixels.len() as u64 * film.samples_per_pixel());
    let developed = film.develop(&pixels, &meter, TruthPixel::of)?;
    let halves = [0, 1].map(|half| {
        let of_half: Vec<PixelMean> = developed
            .iter()
            .map(|pixel| pixel.halves[half].clone())
            .collect();
        picture(width, height, &of_half)
    });
    Ok(Truth {
        provenance: provenance(
            scene,
            settings.seed,
            settings.samples_per_pixel,
            settings.replicates,
            truth_hash(scene, settings),
        ),
        shutter,
        alignment: settings.alignment,
        objects: object_names(scene),
        motion: motion(&Picture::mean(&halves), &moving_objects(scene, shutter)),
        halves,
        standard_error: Image {
            width,
            height,
            pixels: developed.iter().map(|pixel| pixel.standard_error).collect(),
        },
    })
}

impl TruthPixel {
    fn of(replicates: &[Replicate]) -> Self {
        let half = |first: usize| PixelMean::of(replicates.iter().skip(first).step_by(2));
        Self {
            halves: [half(0), half(1)],
            standard_error: standard_error(replicates),
        }
    }
}

/// Standard error of the replicates' mean.
fn standard_error(replicates: &[Replicate]) -> [f32; 3] {
    let count = replicates.len() as f64;
    let mean = replicates
        .iter()
        .map(|replicate| replicate.radiance)
        .sum::<DVec3>()
        / count;
    let squares: DVec3 = replicates
        .iter()
        .map(|replicate| (replicate.radiance - mean).powf(2.0))
        .sum();
    let variance_of_mean = squares / (count * (count - 1.0));
    [variance_of_mean.x, variance_of_mean.y, variance_of_mean.z]
        .map(|variance| variance.sqrt() as f32)
}

/// The summed coverage of what moves.
fn motion(mean: &Picture, moving: &[bool]) -> Plane {
    let still = Plane::filled(mean.color.width, mean.color.height, 0.0);
    mean.coverage
        .iter()
        .zip(moving)
        .filter(|(_, moves)| **moves)
        .fold(still, |sum, (coverage, _)| {
            sum.zip(coverage, |sum, coverage| sum + coverage)
        })
}
