//! An engine that remembers the last frame wrongly: velocity from the shapes, matrices and cameras
//! of two frames, as a rasteriser computes it. It shares nothing with the audit but the scene.

use frame::{Raster, Size, Vectors};
use glam::{DAffine3, DVec3};
use scene::Scene;
use tracer::{Hit, Stage, View};

/// Index of the last frame in a pair.
pub const LAST: usize = 0;
/// Index of this frame in a pair.
pub const THIS: usize = 1;

/// What one draw call knows of the last frame and of this one.
#[derive(Clone)]
pub struct Draw {
    /// Vertices in the object's space, in metres; empty for the background.
    pub shapes: [Vec<DVec3>; 2],
    /// Transforms from the object to the world.
    pub matrices: [DAffine3; 2],
    /// Transforms from the camera to the world.
    pub cameras: [DAffine3; 2],
    /// Vertical fields of view, in radians.
    pub fields_of_view: [f64; 2],
    /// Jitter that nobody removes, in pixels.
    pub jitter: [[f64; 2]; 2],
}

/// Draw calls of an engine, by object id: the background is the first.
pub struct WrongEngine<'a> {
    pub scene: &'a Scene,
    pub draws: Vec<Draw>,
    size: Size,
    hits: Raster<Option<Hit>>,
}

impl<'a> WrongEngine<'a> {
    /// Makes an engine that is right until its draws are changed.
    pub fn new(scene: &'a Scene, size: Size) -> Self {
        let background = Draw {
            shapes: [LAST, THIS].map(|_| Vec::new()),
            matrices: [DAffine3::IDENTITY; 2],
            cameras: [-1.0, 0.0].map(|time| scene.camera.motion.at(time)),
            fields_of_view: [-1.0, 0.0].map(|time| scene.camera.vertical_fov_at(time)),
            jitter: [[0.0; 2]; 2],
        };
        let objects = (0..scene.objects.len()).map(|object| Draw {
            shapes: [-1.0, 0.0].map(|time| shape_at(scene, object, time)),
            matrices: [-1.0, 0.0].map(|time| scene.object_to_world(object, time)),
            ..background.clone()
        });
        Self {
            scene,
            draws: std::iter::once(background.clone()).chain(objects).collect(),
            size,
            hits: find_hits(scene, size),
        }
    }

    /// Draws the velocity.
    pub fn draw(&self) -> Vectors {
        let Size { width, height } = self.size;
        Raster::from_fn(width, height, |x, y| self.velocity_at(x, y))
    }

    fn velocity_at(&self, x: u32, y: u32) -> [f32; 2] {
        let hit = self.hits.at(x, y);
        let draw = &self.draws[hit.map_or(0, |hit| hit.object + 1)];
        let project = |frame: usize| match hit {
            Some(hit) => self.project_point(draw, frame, hit),
            None => {
                let direction = view(self.scene, self.size).ray(x as f64 + 0.5, y as f64 + 0.5);
                let seen = (draw.cameras[frame].inverse()).transform_vector3(direction.direction);
                self.to_picture(draw, frame, seen)
            }
        };
        let [last, this] = [project(LAST), project(THIS)];
        [0, 1].map(|axis| (this[axis] - last[axis]) as f32)
    }

    fn project_point(&self, draw: &Draw, frame: usize, hit: &Hit) -> [f64; 2] {
        let mesh = &self.scene.meshes[self.scene.objects[hit.object].mesh];
        let [a, b, c] =
            mesh.triangles[hit.triangle as usize].map(|vertex| draw.shapes[frame][vertex as usize]);
        let point = a + hit.weights[0] * (b - a) + hit.weights[1] * (c - a);
        let world = draw.matrices[frame].transform_point3(point);
        let seen = draw.cameras[frame].inverse().transform_point3(world);
        self.to_picture(draw, frame, seen)
    }

    /// Divides as engines do, without a look at the sign of points behind the camera.
    fn to_picture(&self, draw: &Draw, frame: usize, seen: DVec3) -> [f64; 2] {
        let [width, height] = [self.size.width, self.size.height].map(f64::from);
        let focal = 0.5 * height / (0.5 * draw.fields_of_view[frame]).tan();
        let [right, up] = [seen.x, seen.y].map(|part| focal * part / -seen.z);
        let jitter = draw.jitter[frame];
        [
            0.5 * width + right + jitter[0],
            0.5 * height - up + jitter[1],
        ]
    }
}

/// Vertices of an object in its own space at a time.
pub fn shape_at(scene: &Scene, object: usize, time: f64) -> Vec<DVec3> {
    let mesh = &scene.meshes[scene.objects[object].mesh];
    mesh.at(time).positions().collect()
}

fn view(scene: &Scene, size: Size) -> View {
    View::new(&scene.camera, 0.0, size.width, size.height)
}

fn find_hits(scene: &Scene, size: Size) -> Raster<Option<Hit>> {
    let stage = Stage::new(scene, 0.0, 0.0);
    let view = view(scene, size);
    let mut poses = stage.poses();
    Raster::from_fn(size.width, size.height, |x, y| {
        let ray = view.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
        stage.closest(poses.at(0.0), &ray)
    })
}
