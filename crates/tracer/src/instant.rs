//! The frame of the instant, as an engine would hand it to its motion blur.

use bvh::Ray;
use frame::{
    Alignment, FAR_DEPTH, Frame, Picture, Plane, Raster, Tile, TracedFrame, Vectors, VelocityKind,
};
use rayon::prelude::*;
use scene::{FrameRate, Scene};

use crate::content_hash::{grid_hash, provenance};
use crate::error::TraceError;
use crate::film::canvas::Canvas;
use crate::film::finite::{check_layer, check_picture};
use crate::film::pilot::{PILOT_REPLICATES, PILOT_SAMPLES, choose_samples};
use crate::film::render::{Film, Times};
use crate::film::sample_counts::SampleCounts;
use crate::hit::Hit;
use crate::material::surface::Sight;
use crate::motion::point_motion::{ObjectsBefore, PointMotion};
use crate::motion::poses::Poses;
use crate::motion::velocity::{TrackedPoint, camera, camera_velocity, reprojection};
use crate::motion::view::View;
use crate::path::integrator::Integrator;
use crate::pixel_grid::{PixelGrid, scale_camera, scale_reprojection};
use crate::progress::{Meter, Watch};
use crate::sampler::Stream;
use crate::settings::{RenderSettings, check_next_frame};
use crate::stage::Stage;
use crate::truth::TruthTracer;

/// A rasteriser's output at the pixels' centres, without colour.
#[derive(Clone, Debug, PartialEq)]
pub struct PointLayers {
    /// Screen motion over one frame, in pixels; +x right, +y down.
    pub velocity: Vectors,
    /// Change of depth over the interval of the velocity, in metres per frame; above 0 moves away.
    pub velocity_z: Plane,
    /// Distance along the view axis, in metres; [`FAR_DEPTH`] where nothing is seen.
    pub depth: Plane,
    /// The object seen, counted from 1; 0 is the background.
    pub object_id: Raster<u32>,
}

/// The values that a rasteriser writes at one pixel's centre.
#[derive(Clone)]
struct PointSample {
    velocity: [f32; 2],
    velocity_z: f32,
    depth: f32,
    object_id: u32,
}

impl PointLayers {
    fn new(scene: &Scene, points: &Raster<PointSample>) -> Result<Self, TraceError> {
        let velocity = points.map(|point| point.velocity);
        check_layer(scene, "velocity", &velocity)?;
        Ok(Self {
            velocity,
            velocity_z: points.map(|point| point.velocity_z),
            depth: points.map(|point| point.depth),
            object_id: points.map(|point| point.object_id),
        })
    }
}

/// Renders the instant `t = 0` in one replicate. Colour and coverage are filtered over each pixel
/// or sampled at its centre. Velocity, depth and object id come from the point at the centre,
/// through translucent surfaces unless a material says otherwise. All rasters extend beyond the
/// picture by the guard band of the settings.
pub fn trace_frame(
    scene: &Scene,
    settings: &RenderSettings,
    watch: Watch,
) -> Result<Frame, TraceError> {
    let grid = PixelGrid::of_picture(settings.width, settings.height);
    let single = RenderSettings {
        replicates: 1,
        ..*settings
    };
    Ok(trace_frame_part(scene, &single, &grid, None, watch)?.frame)
}

/// The time around the instant that a frame's samples are chosen for.
enum OpenShutter<'a> {
    /// The shutter of the truths that go with the frame.
    Truths(TruthTracer<'a>),
    /// The instant alone, of a scene that is not defined while the shutter is open.
    Instant(Stage<'a>),
}

impl<'a> OpenShutter<'a> {
    fn of(scene: &'a Scene, settings: &RenderSettings) -> Result<Self, TraceError> {
        let pair = settings.with_replicates(2);
        match TruthTracer::new(scene, &pair, &[Alignment::Trailing]) {
            Ok(tracer) => Ok(Self::Truths(tracer)),
            Err(_) => Ok(Self::Instant(Stage::try_new(scene, 0.0, 0.0)?)),
        }
    }

    fn stage(&self) -> &Stage<'a> {
        match self {
            Self::Truths(tracer) => tracer.stage(),
            Self::Instant(stage) => stage,
        }
    }

    /// Chooses the samples of every pixel in a replicate: the truths', so that what stands still
    /// has the same samples in both.
    fn choose_samples(
        &self,
        settings: &RenderSettings,
        canvas: Canvas,
        watch: Watch,
    ) -> Result<SampleCounts, TraceError> {
        let stage = match self {
            Self::Truths(tracer) => return tracer.samples_on(canvas, watch),
            Self::Instant(stage) => stage,
        };
        let uniform = SampleCounts::Uniform(PILOT_SAMPLES);
        let pilot = Film {
            replicates: 0..PILOT_REPLICATES,
            samples: &uniform,
            stream: Stream::Pilot,
            ..film_instant(stage, settings, canvas)
        };
        let nothing_moves = vec![false; stage.scene.objects.len() + 1];
        let mean = settings.samples_per_replicate();
        choose_samples(&pilot, &nothing_moves, 0, mean, watch)
    }
}

/// Prepares a film of the instant, without samples.
fn film_instant<'f>(stage: &'f Stage, settings: &RenderSettings, canvas: Canvas) -> Film<'f> {
    Film {
        integrator: Integrator::new(stage, 0.0),
        canvas,
        color: settings.options.color,
        times: &[Times::Instant],
        instant: None,
        recalled: &[],
        replicates: 0..0,
        samples: &SampleCounts::Uniform(0),
        seed: settings.seed,
        stream: Stream::Picture,
    }
}

/// Renders the instant as [`trace_frame`] does, in the replicates of the settings, on another grid
/// of pixels over their picture, and all of it or a tile. Guard band and tile are in pixels of the
/// grid; a tile counts from the band's corner. Its rasters have its size, and the content of the
/// whole frame's there.
///
/// # Errors
/// The settings or the grid do not fit the scene, a pixel is not finite, or the watcher cancelled.
pub fn trace_frame_part(
    scene: &Scene,
    settings: &RenderSettings,
    grid: &PixelGrid,
    tile: Option<Tile>,
    watch: Watch,
) -> Result<TracedFrame, TraceError> {
    settings.check_frame(scene)?;
    let canvas = check_canvas(settings, grid)?;
    let tile = tile.unwrap_or(canvas.whole());
    let pixels = tile.pixels(canvas.columns());
    let shutter = OpenShutter::of(scene, settings)?;
    let (stage, samples) = (
        shutter.stage(),
        &shutter.choose_samples(settings, canvas, watch)?,
    );
    let film = Film {
        replicates: 0..settings.replicates,
        samples,
        ..film_instant(stage, settings, canvas)
    };
    let meter = Meter::new(watch, film.work(&pixels));
    let replicates: Vec<Picture> = (film.render(&pixels, &meter)?.into_iter())
        .map(|mut pictures| pictures.remove(0).into_picture(tile))
        .collect();
    let picture = Picture::mean(&replicates);
    check_picture(scene, &picture)?;
    let points = sample_points(stage, canvas, settings, &PointMotion::RIGHT).part(tile);
    let layers = PointLayers::new(scene, &points)?;
    let hash = grid_hash(scene, settings, grid);
    let count = settings.replicates;
    let frame = Frame {
        provenance: provenance(
            stage,
            settings.seed,
            settings.samples_per_pixel,
            count,
            hash,
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
        velocity_next: None,
        velocity_z: None,
        depth: layers.depth,
        object_id: layers.object_id,
        samples: Some((samples.to_plane(canvas).part(tile)).map(|samples| samples * count as f32)),
    };
    Ok(TracedFrame { frame, replicates })
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
    let grid = PixelGrid::of_picture(settings.width, settings.height);
    trace_motion_on(scene, settings, motion, &grid)
}

/// Samples a rasteriser's output as [`trace_motion`] does, on another grid of pixels over the
/// picture of the settings.
///
/// # Errors
/// The settings or the grid do not fit the scene, or a velocity is not finite.
pub fn trace_motion_on(
    scene: &Scene,
    settings: &RenderSettings,
    motion: &PointMotion,
    grid: &PixelGrid,
) -> Result<PointLayers, TraceError> {
    settings.check_instant(scene)?;
    let canvas = check_canvas(settings, grid)?;
    // Objects stand still if they do over the interval of the motion.
    let from = if motion.through_walls {
        motion.seen_at - motion.over
    } else {
        motion.seen_at
    };
    let stage = Stage::try_new(scene, from, motion.seen_at)?;
    PointLayers::new(scene, &sample_points(&stage, canvas, settings, motion))
}

/// Samples the velocities of a frame that few filters read: the motion to the next frame, and the
/// change of depth over the interval of its velocity. With velocity from only the camera, objects
/// stand still in both.
///
/// # Errors
/// The settings or the grid do not fit the scene, it is not defined up to the next frame, or a
/// velocity is not finite.
pub fn trace_further_velocities(
    scene: &Scene,
    settings: &RenderSettings,
    grid: &PixelGrid,
) -> Result<(Vectors, Plane), TraceError> {
    check_next_frame(scene)?;
    let layers = trace_motion_on(scene, settings, &PointMotion::RIGHT, grid)?;
    check_layer(scene, "velocity_z", &layers.velocity_z.map(|z| [*z]))?;
    let motion = match settings.options.velocity {
        VelocityKind::CameraOnly => PointMotion {
            objects_before: ObjectsBefore::Now,
            ..PointMotion::TO_NEXT
        },
        _ => PointMotion::TO_NEXT,
    };
    let mut settings = *settings;
    settings.options.velocity = VelocityKind::Instantaneous;
    let next = trace_motion_on(scene, &settings, &motion, grid)?;
    Ok((next.velocity, layers.velocity_z))
}

/// Makes the canvas of a grid; refuses a grid of an impossible size.
fn check_canvas(settings: &RenderSettings, grid: &PixelGrid) -> Result<Canvas, TraceError> {
    settings.with_size(grid.size).check_sizes()?;
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
    let view = View::new(&scene.camera, motion.seen_at, size.width, size.height);
    let before = reprojection(scene, size);
    let points = (canvas.pixels().into_par_iter())
        .map_init(
            || stage.poses(),
            |poses, pixel| {
                let centre = canvas.place(pixel, [0.5; 2]);
                let ray = view.ray(centre[0], centre[1]);
                let hit = if motion.through_walls {
                    find_mover(stage, poses.at(motion.seen_at), &ray)
                } else {
                    None
                };
                let hit = hit.or_else(|| {
                    stage.closest_in_sight(poses.at(motion.seen_at), &ray, Sight::Buffers)
                });
                let depth = hit.map_or(FAR_DEPTH, |hit| view.depth(ray.at(hit.t)) as f32);
                let tracked = TrackedPoint::of(hit, ray.direction);
                let follow = |motion| tracked.velocity(scene, size, options.velocity, motion);
                let velocity = if hit.is_none() && !options.sky_velocity {
                    [0.0; 3]
                } else if options.velocity == VelocityKind::CameraOnly {
                    let depth = hit.map_or(f64::INFINITY, |_| f64::from(depth));
                    let [x, y] = camera_velocity(&before, centre, depth);
                    [x, y, follow(&PointMotion::WITHOUT_OBJECTS)[2]]
                } else {
                    follow(motion)
                };
                PointSample {
                    velocity: [0, 1].map(|axis| (velocity[axis] / canvas.step[axis]) as f32),
                    velocity_z: velocity[2] as f32,
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

/// Finds the nearest surface on a ray that moves, whatever hides it.
fn find_mover(stage: &Stage, poses: &mut Poses, ray: &Ray) -> Option<Hit> {
    let mut next = stage.closest(poses, ray);
    while let Some(hit) = next.filter(|hit| stage.object_stands_still(hit.object)) {
        next = stage.closest_behind(poses, ray, &hit);
    }
    next
}
