//! Cameras: the file's own, or one framed on the model.

use glam::{DMat3, DMat4, DQuat, DVec2, DVec3};

use super::keys::Path;
use super::moment::Moment;
use super::stage::Stage;

/// Nearest point that is measured, as a part of its distance: others are beside the camera.
const NEAREST: f64 = 0.05;

/// Size and field of view of the picture.
#[derive(Clone, Copy, Debug)]
pub struct Film {
    pub width: u32,
    pub height: u32,
    /// Radians.
    pub vertical_fov: f64,
}

/// Pose of the camera, which looks along its -Z.
#[derive(Clone, Copy, Debug)]
pub struct View {
    pub position: DVec3,
    pub orientation: DQuat,
}

/// The way of the camera.
#[derive(Clone, Copy, Debug)]
pub enum Camera {
    /// It is a node.
    Node(usize),
    /// It looks at a point from a direction, and goes around it.
    Around {
        target: DVec3,
        distance: f64,
        /// Degrees around and above the target.
        direction: [f64; 2],
        /// Degrees per frame.
        orbit: f64,
    },
}

impl Film {
    /// Returns where a point is in the picture, in pixels; none if it is not near the picture.
    pub fn pixel(&self, view: &View, point: DVec3) -> Option<DVec2> {
        let local = view.orientation.inverse() * (point - view.position);
        let depth = -local.z;
        if depth <= NEAREST * local.length() {
            return None;
        }
        let [width, height] = [self.width, self.height].map(f64::from);
        let focal = 0.5 * height / (0.5 * self.vertical_fov).tan();
        let place = DVec2::new(local.x, -local.y) * (focal / depth);
        // A whole picture around the picture is measured too.
        let is_near = place.x.abs() < 1.5 * width && place.y.abs() < 1.5 * height;
        is_near.then_some(place)
    }
}

impl View {
    /// Makes the view of a node: its place and its axes, without scale.
    fn of_node(world: &DMat4) -> Self {
        let back = world.z_axis.truncate().normalize_or(DVec3::Z);
        let right = world.y_axis.truncate().cross(back).normalize_or(DVec3::X);
        let axes = DMat3::from_cols(right, back.cross(right), back);
        Self {
            position: world.w_axis.truncate(),
            orientation: DQuat::from_mat3(&axes).normalize(),
        }
    }
}

impl Camera {
    pub fn view(&self, stage: &Stage, moment: Moment) -> View {
        match self {
            Self::Node(node) => View::of_node(&stage.world(*node, moment.seconds)),
            Self::Around {
                target,
                distance,
                direction,
                orbit,
            } => {
                let around = (direction[0] + orbit * moment.frame).to_radians();
                let orientation = DQuat::from_rotation_y(around)
                    * DQuat::from_rotation_x(-direction[1].to_radians());
                View {
                    position: *target + orientation * DVec3::new(0.0, 0.0, *distance),
                    orientation,
                }
            }
        }
    }

    pub fn is_moving(&self, stage: &Stage) -> bool {
        match self {
            Self::Node(node) => stage.is_moving[*node],
            Self::Around { orbit, .. } => *orbit != 0.0,
        }
    }
}

/// The camera's own path, measured on points that stand still.
pub struct CameraPath<'a> {
    pub stage: &'a Stage,
    pub film: Film,
    pub camera: Camera,
    pub points: Vec<DVec3>,
}

impl Path for CameraPath<'_> {
    type Key = View;

    fn key(&self, moment: Moment) -> View {
        self.camera.view(self.stage, moment)
    }

    fn mix(&self, [from, to]: [&View; 2], part: f64) -> View {
        View {
            position: from.position.lerp(to.position, part),
            orientation: from.orientation.slerp(to.orientation, part),
        }
    }

    fn pixels(&self, view: &View, _: Moment) -> Vec<Option<DVec2>> {
        let points = self.points.iter();
        points.map(|point| self.film.pixel(view, *point)).collect()
    }
}
