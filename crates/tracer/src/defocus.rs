//! Depth of field as a pass over a picture of a pinhole: the best that one can do with the geometry
//! of the instant.

use frame::{Image, Picture, Plane, Raster};
use glam::DVec3;
use rayon::prelude::*;
use scene::Scene;

use crate::error::TraceError;
use crate::film::at_instant::InstantView;
use crate::film::canvas::Canvas;
use crate::film::eye::{Eye, EyeRay};
use crate::film::render::for_each_pixel;
use crate::material::surface::Sight;
use crate::motion::lens::LensPoint;
use crate::path::integrator::Integrator;
use crate::path::stops::Stop;
use crate::progress::{Meter, Watch};
use crate::sampler::{Sampler, Stream, pixel_seed};
use crate::settings::RenderSettings;
use crate::stage::Stage;

/// Rays per pixel, a power of two. Time grows with them; noise falls with about their number to the
/// power of 0.75.
const SAMPLES: u32 = 256;
/// Seed of the rays, the same for all pictures, so that the pass depends on scene and size alone.
const SEED: u64 = 0;

/// A number that a pixel's rays found, and how many found it.
#[derive(Clone, Copy)]
struct Found {
    /// Index of a pixel, or id of an object.
    number: u32,
    times: u32,
}

/// Effect of a pass on one pixel: the mean over its rays.
struct Recipe {
    /// Pixels of the picture that rays read.
    reads: Vec<Found>,
    /// Radiance of the rays that read nothing, summed up.
    hidden: DVec3,
    /// Objects that they met, by id.
    hidden_objects: Vec<Found>,
}

/// A depth of field that is applied to pictures of a scene's pinhole.
///
/// The rays of a pixel go through all of the lens at the instant. Each reads the picture where the
/// pinhole shows the point that it meets. Behind edges and outside the picture, a ray may meet a
/// point that the pinhole does not show: it is traced instead, at the instant. So without motion
/// the pass gives the lens' own picture of the instant, except for noise and for edges, which are
/// read with the width of a pixel. It knows nothing of motion: light that a blur smeared over a
/// pixel counts as a part of that pixel at the instant.
pub struct Defocus(Raster<Recipe>);

/// Prepares the pass of a scene, for pictures of the settings' size without a guard band.
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
    let integrator = &Integrator::new(stage, 0.0);
    let pinhole = &InstantView::of_pinhole(stage, canvas);
    let pixels = canvas.pixels();
    let meter = Meter::new(watch, pixels.len() as u64);
    let work = |task: &[u32]| task.len() as u64;
    let recipes = for_each_pixel((stage, canvas), &pixels, &meter, work, |eye, pixel| {
        find_recipe(integrator, pinhole, canvas, eye, pixel)
    })?;
    Ok(Defocus(Raster {
        width: canvas.width,
        height: canvas.height,
        pixels: recipes,
    }))
}

/// Sends a pixel's rays through the lens.
fn find_recipe(
    integrator: &Integrator,
    pinhole: &InstantView,
    canvas: Canvas,
    eye: &mut Eye,
    pixel: u32,
) -> Recipe {
    let stage = integrator.stage;
    let seed = pixel_seed(SEED, Stream::Defocus, pixel, 0);
    let mut reads = Vec::with_capacity(SAMPLES as usize);
    let mut hidden = DVec3::ZERO;
    let mut hidden_objects = Vec::new();
    for index in 0..SAMPLES {
        let sampler = Sampler::new(seed, index);
        let [x, y, ..] = sampler.camera();
        let eye_ray = eye.ray_at(0.0, canvas.place(pixel, [x, y]), &sampler);
        let hit = stage.closest_in_sight(&mut eye.poses, &eye_ray.ray, Sight::Buffers);
        let from_centre = EyeRay {
            from: LensPoint::CENTRE,
            ..eye_ray
        };
        let poses = (&mut eye.poses, &mut eye.instant);
        let point = pinhole.look_back(stage, poses, &from_centre, hit.as_ref());
        match point.place.filter(|_| point.is_shown) {
            Some(place) => {
                let last = [canvas.width - 1, canvas.height - 1];
                // Places on the very border count as inside.
                let [column, row] =
                    [0, 1].map(|axis| (place[axis].max(0.0) as u32).min(last[axis]));
                reads.push(row * canvas.width + column);
            }
            None => {
                let stop = hit.map(Stop::scattering);
                let path = integrator.follow_path(&mut eye.poses, eye_ray.ray, stop, &sampler);
                hidden += path.0.as_dvec3();
                hidden_objects.push(hit.map_or(0, |hit| hit.object as u32 + 1));
            }
        }
    }
    Recipe {
        reads: count(reads),
        hidden,
        hidden_objects: count(hidden_objects),
    }
}

/// Counts how often each number occurs.
fn count(mut numbers: Vec<u32>) -> Vec<Found> {
    numbers.sort_unstable();
    let runs = numbers.chunk_by(|a, b| a == b);
    runs.map(|run| Found {
        number: run[0],
        times: run.len() as u32,
    })
    .collect()
}

impl Recipe {
    /// The sum over the rays that read a raster.
    fn sum<const N: usize>(&self, value: impl Fn(usize) -> [f32; N]) -> [f64; N] {
        self.reads.iter().fold([0.0; N], |mut sum, read| {
            for (sum, value) in sum.iter_mut().zip(value(read.number as usize)) {
                *sum += f64::from(read.times) * f64::from(value);
            }
            sum
        })
    }
}

impl Defocus {
    /// Applies the pass to a picture of its size.
    ///
    /// # Panics
    /// The picture has another size.
    pub fn apply(&self, picture: &Picture) -> Picture {
        Picture {
            color: self.apply_to_color(&picture.color),
            coverage: (picture.coverage.iter().enumerate())
                .map(|(object, plane)| self.apply_to_matte(object as u32, plane))
                .collect(),
        }
    }

    /// Applies the pass to the colour of a picture of its size.
    ///
    /// # Panics
    /// The colour has another size.
    pub fn apply_to_color(&self, color: &Image) -> Image {
        self.apply_to_each(color, |recipe| {
            let sum = recipe.sum(|pixel| color.pixels[pixel]);
            let sum = DVec3::from(sum) + recipe.hidden;
            (sum / f64::from(SAMPLES)).as_vec3().to_array()
        })
    }

    /// Applies the pass to the coverage of an object, by its id.
    fn apply_to_matte(&self, object: u32, plane: &Plane) -> Plane {
        self.apply_to_each(plane, |recipe| {
            let [sum] = recipe.sum(|pixel| [plane.pixels[pixel]]);
            let mut met = recipe.hidden_objects.iter();
            let met = met.find(|met| met.number == object);
            let hidden = met.map_or(0.0, |met| f64::from(met.times));
            ((sum + hidden) / f64::from(SAMPLES)) as f32
        })
    }

    fn apply_to_each<T: Send>(
        &self,
        raster: &Raster<T>,
        mean: impl Fn(&Recipe) -> T + Sync + Send,
    ) -> Raster<T> {
        assert!(
            self.0.same_size(raster),
            "the pass is for pictures of one size"
        );
        Raster {
            width: raster.width,
            height: raster.height,
            pixels: self.0.pixels.par_iter().map(mean).collect(),
        }
    }
}
