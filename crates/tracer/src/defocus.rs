//! Depth of field as a pass over a picture of a pinhole: the best that one can do with the geometry of the instant.

use frame::{Plane, Raster};
use rayon::prelude::*;

use crate::error::TraceError;
use crate::film::at_instant::InstantView;
use crate::film::canvas::Canvas;
use crate::film::eye::{Eye, EyeRay};
use crate::film::render::PIXELS_PER_TASK;
use crate::film::sampler::{Sampler, Stream, pixel_seed};
use crate::material::sight::Sight;
use crate::motion::lens::LensPoint;
use crate::progress::{Meter, Watch};
use crate::scene::Scene;
use crate::settings::RenderSettings;
use crate::stage::Stage;

/// Rays per pixel, a power of two. Time grows with them; noise falls with about their number to the power of 0.75.
const SAMPLES: u32 = 256;
/// Seed of the rays, the same for all pictures, so that the pass is one of a scene and a size.
const SEED: u64 = 0;

/// A pixel that a pass reads, and how often.
#[derive(Clone, Copy)]
struct Read {
    pixel: u32,
    times: u32,
}

/// A depth of field that is applied to pictures of a scene's pinhole: for each pixel, the pixels whose mean it becomes.
///
/// The rays of a pixel go through all of the lens at the instant. Each reads the picture where the pinhole shows what the ray meets. A
/// ray that meets what the pinhole does not show, behind an edge or outside of the picture, is left out. So the pass knows the
/// geometry of the instant exactly, and knows nothing of motion: what a blur has smeared over a pixel is taken for a part of what
/// the pixel showed at the instant.
pub struct Defocus {
    width: u32,
    height: u32,
    /// For each pixel what it reads; its own pixel where all rays are left out.
    reads: Vec<Vec<Read>>,
}

/// Finds what the pass of a scene reads, for pictures of the settings' size without a guard band. A scene without a lens reads each
/// pixel alone.
///
/// # Errors
/// The settings do not fit the scene, or the watcher cancelled.
pub fn trace_defocus(
    scene: &Scene,
    settings: &RenderSettings,
    watch: Watch,
) -> Result<Defocus, TraceError> {
    settings.check_frame(scene)?;
    let canvas = Canvas::bare(settings.width, settings.height);
    let stage = &Stage::try_new(scene, 0.0, 0.0)?;
    let pinhole = &InstantView::of_pinhole(stage, canvas);
    let pixels = canvas.pixels();
    let meter = Meter::new(watch, pixels.len() as u64);
    let tasks = pixels
        .par_chunks(PIXELS_PER_TASK)
        .map(|task| {
            meter.check()?;
            let mut eye = Eye::new(stage, canvas);
            let reads = task.iter().map(|&pixel| {
                let reads = find_reads(stage, pinhole, canvas, &mut eye, pixel);
                count_reads(reads, pixel)
            });
            let reads: Vec<Vec<Read>> = reads.collect();
            meter.advance(task.len() as u64);
            Ok(reads)
        })
        .collect::<Result<Vec<Vec<Vec<Read>>>, TraceError>>()?;
    meter.check()?;
    Ok(Defocus {
        width: canvas.width,
        height: canvas.height,
        reads: tasks.into_iter().flatten().collect(),
    })
}

/// Lists the pixels in which the pinhole shows what a pixel's rays through the lens meet.
fn find_reads(
    stage: &Stage,
    pinhole: &InstantView,
    canvas: Canvas,
    eye: &mut Eye,
    pixel: u32,
) -> Vec<u32> {
    let seed = pixel_seed(SEED, Stream::Defocus, pixel, 0);
    let mut reads = Vec::with_capacity(SAMPLES as usize);
    for index in 0..SAMPLES {
        let sampler = Sampler::new(seed, index);
        let [x, y, ..] = sampler.camera();
        let own = eye.ray_at(0.0, canvas.place(pixel, [x, y]), &sampler);
        let hit = stage.closest_in_sight(&mut eye.poses, &own.ray, Sight::Buffers);
        let from_centre = EyeRay {
            from: LensPoint::CENTRE,
            ..own
        };
        let poses = (&mut eye.poses, &mut eye.instant);
        let point = pinhole.look_back(stage, poses, &from_centre, hit.as_ref());
        if let Some(place) = point.place.filter(|_| point.is_shown) {
            let last = [canvas.width - 1, canvas.height - 1];
            // Places on the very border count as inside.
            let [column, row] = [0, 1].map(|axis| (place[axis].max(0.0) as u32).min(last[axis]));
            reads.push(row * canvas.width + column);
        }
    }
    reads
}

/// Counts how often each pixel is read.
fn count_reads(mut pixels: Vec<u32>, own: u32) -> Vec<Read> {
    if pixels.is_empty() {
        pixels.push(own);
    }
    pixels.sort_unstable();
    let runs = pixels.chunk_by(|a, b| a == b);
    runs.map(|run| Read {
        pixel: run[0],
        times: run.len() as u32,
    })
    .collect()
}

impl Defocus {
    /// Applies the pass to a picture of its size.
    ///
    /// # Panics
    /// The picture has another size.
    pub fn apply<const N: usize>(&self, picture: &Raster<[f32; N]>) -> Raster<[f32; N]> {
        assert_eq!(
            (picture.width, picture.height),
            (self.width, self.height),
            "the pass is for pictures of one size"
        );
        let mean = |reads: &Vec<Read>| {
            let mut sum = [0.0; N];
            let mut times = 0.0;
            for read in reads {
                let weight = f64::from(read.times);
                times += weight;
                let value = &picture.pixels[read.pixel as usize];
                for (sum, value) in sum.iter_mut().zip(value) {
                    *sum += weight * f64::from(*value);
                }
            }
            sum.map(|sum| (sum / times) as f32)
        };
        Raster {
            width: self.width,
            height: self.height,
            pixels: self.reads.par_iter().map(mean).collect(),
        }
    }

    /// Applies the pass to a plane of its size.
    pub fn apply_to_plane(&self, plane: &Plane) -> Plane {
        self.apply(&plane.map(|value| [*value]))
            .map(|[value]| *value)
    }
}
