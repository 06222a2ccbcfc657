//! The frame of the instant: what an engine would hand to its motion blur.

use frame::{FAR_DEPTH, Frame, Raster};
use rayon::prelude::*;

use crate::film::{Film, PixelMean, Times, picture};
use crate::path::Integrator;
use crate::progress::{Meter, Watch};
use crate::provenance::{frame_hash, object_names, provenance};
use crate::sampler::Stream;
use crate::scene::Scene;
use crate::settings::{FrameSettings, TraceError};
use crate::stage::Stage;
use crate::velocity::Tracked;

/// What a rasteriser would have written at one pixel's centre.
struct PointSample {
    velocity: [f32; 2],
    depth: f32,
    object_id: u32,
}

/// Renders the instant `t = 0`: colour and coverage filtered over each pixel; velocity, depth and object id of what
/// is seen at its centre.
pub fn trace_frame(
    scene: &Scene,
    settings: &FrameSettings,
    watch: Watch,
) -> Result<Frame, TraceError> {
    settings.check(scene)?;
    let (width, height) = (settings.width, settings.height);
    let stage = Stage::new(scene, 0.0, 0.0);
    let film = Film {
        integrator: Integrator::new(&stage, 0.0),
        width,
        height,
        times: Times::Instant,
        replicates: 0..1,
        samples_per_replicate: settings.samples_per_pixel,
        seed: settings.seed,
        stream: Stream::Frame,
    };
    let pixels: Vec<u32> = (0..width * height).collect();
    let meter = Meter::new(
        watch,
        pixels.len() as u64 * u64::from(settings.samples_per_pixel),
    );
    let filtered = film.develop(&pixels, &meter, |estimates| PixelMean::of(estimates))?;
    let filtered = picture(width, height, &filtered);
    let points = Raster {
        width,
        height,
        pixels: point_samples(&stage, settings),
    };
    Ok(Frame {
        provenance: provenance(
            scene,
            settings.seed,
            settings.samples_per_pixel,
            1,
            frame_hash(scene, settings),
        ),
        exposure: settings.exposure,
        velocity_kind: settings.velocity,
        objects: object_names(scene),
        color: filtered.color,
        coverage: filtered.coverage,
        velocity: points.map(|point| point.velocity),
        depth: points.map(|point| point.depth),
        object_id: points.map(|point| point.object_id),
    })
}

fn point_samples(stage: &Stage, settings: &FrameSettings) -> Vec<PointSample> {
    let scene = stage.scene;
    let size = [settings.width, settings.height];
    let view = scene.camera.view(0.0, size[0], size[1]);
    (0..size[0] * size[1])
        .into_par_iter()
        .map_init(
            || stage.poses(),
            |poses, pixel| {
                let centre = [pixel % size[0], pixel / size[0]].map(|index| f64::from(index) + 0.5);
                let ray = view.ray(centre[0], centre[1]);
                let hit = stage.closest(poses.at(0.0), &ray);
                let tracked = Tracked::of(hit.as_ref(), ray.direction);
                PointSample {
                    velocity: tracked
                        .velocity(scene, size, settings.velocity)
                        .map(|component| component as f32),
                    depth: hit.map_or(FAR_DEPTH, |hit| view.depth(ray.at(hit.t)) as f32),
                    object_id: hit.map_or(0, |hit| hit.object as u32 + 1),
                }
            },
        )
        .collect()
}
