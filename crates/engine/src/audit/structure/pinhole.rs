//! A camera without a lens, at one time for its place and one for its zoom.

use frame::Size;
use glam::{DAffine3, DVec3};
use scene::Camera;

/// Projection of the world to a picture.
#[derive(Clone, Copy, Debug)]
pub struct Pinhole {
    to_camera: DAffine3,
    /// Focal length in pixels.
    focal: f64,
    /// Half the picture's width and height, in pixels.
    half: [f64; 2],
}

impl Pinhole {
    /// Makes the camera of one time (frames).
    pub fn at(camera: &Camera, time: f64, size: Size) -> Self {
        Self::new(camera, time, time, size)
    }

    /// Makes a camera that is placed as at one time and zooms as at another.
    pub fn new(camera: &Camera, placed_at: f64, zooms_at: f64, size: Size) -> Self {
        let placed = camera.motion.at(placed_at);
        Self::with_pose(placed, 0.5 * camera.vertical_fov_at(zooms_at), size)
    }

    /// Makes a camera that stays where it is at the instant, and is turned and zoomed as at a time.
    pub fn turned(camera: &Camera, time: f64, size: Size) -> Self {
        let pose = DAffine3 {
            translation: camera.motion.at(0.0).translation,
            ..camera.motion.at(time)
        };
        Self::with_pose(pose, 0.5 * camera.vertical_fov_at(time), size)
    }

    /// Makes a camera with half an angle of view, in radians.
    fn with_pose(pose: DAffine3, half_angle: f64, size: Size) -> Self {
        let half = [size.width, size.height].map(|side| 0.5 * f64::from(side));
        Self {
            to_camera: pose.inverse(),
            focal: half[1] / half_angle.tan(),
            half,
        }
    }

    /// Projects a point of the world to pixels from the top left. Behind the camera, the place is
    /// mirrored, as an engine that divides without a look at the sign has it.
    pub fn project_point(&self, point: DVec3) -> [f64; 2] {
        self.project(self.to_camera.transform_point3(point))
    }

    /// Projects a direction of the world, of a point at infinity.
    pub fn project_direction(&self, direction: DVec3) -> [f64; 2] {
        self.project(self.to_camera.transform_vector3(direction))
    }

    fn project(&self, seen: DVec3) -> [f64; 2] {
        let [across, up] = [seen.x, seen.y].map(|part| self.focal * part / -seen.z);
        [self.half[0] + across, self.half[1] - up]
    }
}
