//! The frame of the instant, as an engine would hand it to its motion blur.

use frame::{FAR_DEPTH, Frame, Plane, Raster, Tile, Vectors, VelocityKind};
use rayon::prelude::*;

use crate::content_hash::{grid_hash, provenance};
use crate::error::TraceError;
use crate::film::canvas::Canvas;
use crate::film::finite::{check_layer, check_picture};
use crate::film::pilot::{PILOT_REPLICATES, PILOT_SAMPLES, choose_samples};
use crate::film::render::{Film, PixelMean, Times, assemble_picture};
use crate::film::sample_counts::SampleCounts;
use crate::frame_rate::FrameRate;
use crate::material::surface::Sight;
use crate::motion::velocity::{PointMotion, TrackedPoint, camera, camera_velocity, reprojection};
use crate::path::integrator::Integrator;
use crate::pixel_grid::{PixelGrid, scale_camera, scale_reprojection};
use crate::progress::{Meter, Watch};
use crate::sampler::Stream;
use crate::scene::Scene;
use crate::settings::RenderSettings;
use crate::stage::Stage;

/// A rasteriser's output at the pixels' centres, without colour.
#[derive(Clone, Debug, PartialEq)]
pub struct PointLayers {
    /// Screen motion over one frame, in pixels; +x right, +y down.
    pub velocity: Vectors,
    /// Distance along the view axis, in metres; [`FAR_DEPTH`] where nothing is seen.
    pub depth: Plane,
    /// The object seen, counted from 1; 0 is the background.
    pub object_id: Raster<u32>,
}

/// The values that a rasteriser writes at one pixel's centre.
#[derive(Clone)]
struct PointSample {
    velocity: [f32; 2],
    depth: f32,
    object_id: u32,
}

impl PointLayers {
    fn new(scene: &Scene, points: &Raster<PointSample>) -> Result<Self, TraceError> {
        let velocity = points.map(|point| point.velocity);
        check_layer(scene, "velocity", &velocity)?;
        Ok(Self {
            velocity,
            depth: points.map(|point| point.depth),
            object_id: points.map(|point| point.object_id),
        })
    }
}

/// Renders the instant `t = 0`. Colour and coverage are filtered over each pixel or sampled at its centre. Velocity, depth and
/// object id come from the point at the centre, through translucent surfaces unless a material says otherwise. All rasters
/// extend beyond the picture by the guard band of the settings.
pub fn trace_frame(
    scene: &Scene,
    settings: &RenderSettings,
    watch: Watch,
) -> Result<Frame, TraceError> {
    let own = PixelGrid::of_picture(settings.width, settings.height);
    trace_frame_part(scene, settings, &own, None, watch)
}

/// Renders the instant as [`trace_frame`] does, on another grid of pixels over the picture of the settings, and all of it or a
/// tile. Guard band and tile are in pixels of the grid; a tile counts from the band's corner. Its rasters have its size, and
/// the content of the whole frame's there.
///
/// # Errors
/// The settings or the grid do not fit the scene, a pixel is not finite, or the watcher cancelled.
pub fn trace_frame_part(
    scene: &Scene,
    settings: &RenderSettings,
    grid: &PixelGrid,
    tile: Option<Tile>,
    watch: Watch,
) -> Result<Frame, TraceError> {
    settings.check_frame(scene)?;
    let canvas = check_canvas(settings, grid)?;
    let tile = tile.unwrap_or(canvas.whole());
    let stage = &Stage::try_new(scene, 0.0, 0.0)?;
    let make_film = |samples, replicates, stream| Film {
        integrator: Integrator::new(stage, 0.0),
        canvas,
        color: settings.options.color,
        times: &[Times::Instant],
        instant: None,
        shaded_again: 1,
        replicates,
        samples,
        seed: settings.seed,
        stream,
    };
    let pixels = tile.pixels(canvas.columns());
    let uniform = SampleCounts::Uniform(PILOT_SAMPLES);
    let pilot = make_film(&uniform, 0..PILOT_REPLICATES, Stream::FramePilot);
    let nothing_moves = vec![false; scene.objects.len() + 1];
    let samples = choose_samples(&pilot, &nothing_moves, 0, settings.samples_per_pixel, watch)?;
    let film = make_film(&samples, 0..1, Stream::Frame);
    let meter = Meter::new(watch, film.work(&pixels));
    let pixel_means = film.render(&pixels, &meter, |estimates| PixelMean::of(&estimates[0]))?;
    let picture = assemble_picture(tile, &pixel_means);
    check_picture(scene, &picture)?;
    let points = sample_points(stage, canvas, settings, &PointMotion::RIGHT).part(tile);
    let layers = PointLayers::new(scene, &points)?;
    Ok(Frame {
        provenance: provenance(
            stage,
            settings.seed,
            settings.samples_per_pixel,
            1,
            grid_hash(scene, settings, grid),
        ),
        exposure: settings.exposure(scene),
        frames_per_second: Some(scene.rate().per_second)
            .filter(|rate| *rate != FrameRate::WRITTEN.per_second),
        options: settings.options,
        guard_band: settings.guard_band,
        reprojection: scale_reprojection(reprojection(scene, canvas.view), canvas.step),
        camera: Some(scale_camera(camera(scene, canvas.view), canvas.step)),
        display: scene.display,
        objects: scene.object_names(),
        color: picture.color,
        coverage: picture.coverage,
        velocity: layers.velocity,
        depth: layers.depth,
        object_id: layers.object_id,
        samples: Some(samples.to_plane(canvas).part(tile)),
    })
}

/// Samples a rasteriser's output for other points or another motion than the frame's.
///
/// # Errors
/// The settings do not fit the scene, or a velocity is not finite.
pub fn trace_motion(
    scene: &Scene,
    settings: &RenderSettings,
    motion: &PointMotion,
) -> Result<PointLayers, TraceError> {
    let own = PixelGrid::of_picture(settings.width, settings.height);
    trace_motion_on(scene, settings, motion, &own)
}

/// Samples a rasteriser's output as [`trace_motion`] does, on another grid of pixels over the picture of the settings.
///
/// # Errors
/// The settings or the grid do not fit the scene, or a velocity is not finite.
pub fn trace_motion_on(
    scene: &Scene,
    settings: &RenderSettings,
    motion: &PointMotion,
    grid: &PixelGrid,
) -> Result<PointLayers, TraceError> {
    settings.check_frame(scene)?;
    let canvas = check_canvas(settings, grid)?;
    let stage = Stage::try_new(scene, motion.seen_at, motion.seen_at)?;
    PointLayers::new(scene, &sample_points(&stage, canvas, settings, motion))
}

/// Makes the canvas of a grid; refuses a grid of an impossible size.
fn check_canvas(settings: &RenderSettings, grid: &PixelGrid) -> Result<Canvas, TraceError> {
    let [width, height] = grid.size;
    let own = RenderSettings {
        width,
        height,
        ..*settings
    };
    own.check_sizes()?;
    let band = settings.guard_band;
    Ok(Canvas::new(settings.width, settings.height, band, grid))
}

/// Samples a rasteriser's output at the centres of all pixels.
fn sample_points(
    stage: &Stage,
    canvas: Canvas,
    settings: &RenderSettings,
    motion: &PointMotion,
) -> Raster<PointSample> {
    let scene = stage.scene;
    let options = settings.options;
    let size = canvas.view;
    let view = scene.camera.view(motion.seen_at, size[0], size[1]);
    let before = reprojection(scene, size);
    let points = (canvas.pixels().into_par_iter())
        .map_init(
            || stage.poses(),
            |poses, pixel| {
                let centre = canvas.place(pixel, [0.5; 2]);
                let ray = view.ray(centre[0], centre[1]);
                let hit = stage.closest_in_sight(poses.at(motion.seen_at), &ray, Sight::Buffers);
                let depth = hit.map_or(FAR_DEPTH, |hit| view.depth(ray.at(hit.t)) as f32);
                let velocity = if hit.is_none() && !options.sky_velocity {
                    [0.0, 0.0]
                } else if options.velocity == VelocityKind::CameraOnly {
                    let depth = hit.map_or(f64::INFINITY, |_| f64::from(depth));
                    camera_velocity(&before, centre, depth)
                } else {
                    let tracked = TrackedPoint::of(hit, ray.direction);
                    tracked.velocity(scene, size, options.velocity, motion)
                };
                PointSample {
                    velocity: [0, 1].map(|axis| (velocity[axis] / canvas.step[axis]) as f32),
                    depth,
                    object_id: hit.map_or(0, |hit| hit.object as u32 + 1),
                }
            },
        )
        .collect();
    Raster {
        width: canvas.columns(),
        height: canvas.rows(),
        pixels: points,
    }
}
