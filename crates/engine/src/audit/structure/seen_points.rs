//! Points that a picture shows at its pixels' centres, and their places under other matrices.

use frame::{Raster, Size};
use glam::{DAffine3, DVec3};
use scene::Scene;
use tracer::{Hit, Ray, Stage, TraceError, View};

use crate::audit::structure::pinhole::Pinhole;

/// Upper limit on the translucent surfaces before the one that velocity belongs to.
const MOST_SURFACES: usize = 32;
/// Step beyond a surface, relative to its distance.
const STEP: f64 = 1e-6;

/// A point that a pixel shows.
#[derive(Clone, Copy, Debug)]
pub enum SeenPoint {
    /// A point of a surface.
    Surface(Hit),
    /// A direction of the background, in the world.
    Infinity(DVec3),
}

/// What a draw call uses in one frame.
#[derive(Clone, Copy, Debug)]
pub struct Drawn {
    /// Time of the shape, in frames.
    pub shape_at: f64,
    /// Transform from the object to the world.
    pub to_world: DAffine3,
    /// Camera.
    pub camera: Pinhole,
}

/// Traces the points of a picture at the instant; none where the surface of the object with that id
/// is not met.
pub fn trace_points(
    scene: &Scene,
    size: Size,
    ids: &Raster<u32>,
) -> Result<Vec<Option<SeenPoint>>, TraceError> {
    let stage = Stage::try_new(scene, 0.0, 0.0)?;
    let view = View::new(&scene.camera, 0.0, size.width, size.height);
    let mut poses = stage.poses();
    let points = ids.pixels.iter().enumerate().map(|(at, id)| {
        let [x, y] = [at as u32 % size.width, at as u32 / size.width];
        let ray = view.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let Some(object) = (*id as usize).checked_sub(1) else {
            return Some(SeenPoint::Infinity(ray.direction));
        };
        let mut start = 0.0;
        for _ in 0..MOST_SURFACES {
            let origin = ray.at(start);
            let hit = stage.closest(poses.at(0.0), &Ray { origin, ..ray })?;
            if hit.object == object {
                return Some(SeenPoint::Surface(hit));
            }
            start += hit.t * (1.0 + STEP);
        }
        None
    });
    Ok(points.collect())
}

impl SeenPoint {
    /// Returns the place of the point as a draw call shows it, in pixels.
    pub fn place(&self, scene: &Scene, drawn: &Drawn) -> [f64; 2] {
        match self {
            Self::Surface(hit) => drawn.camera.project_point(place_hit(hit, scene, drawn)),
            Self::Infinity(direction) => drawn.camera.project_direction(*direction),
        }
    }
}

/// Returns the place in the world of a point of a surface, as a draw call has it.
pub fn place_hit(hit: &Hit, scene: &Scene, drawn: &Drawn) -> DVec3 {
    let mesh = &scene.meshes[scene.objects[hit.object].mesh];
    let point = mesh.at(drawn.shape_at).point(hit.triangle, hit.weights);
    drawn.to_world.transform_point3(point)
}
