//! A view of the camera at one time: rays through pixels and its lens, and projection back to them.

use bvh::Ray;
use frame::CameraPose;
use glam::{DAffine3, DVec2, DVec3};
use scene::{Camera, Lens};

use crate::motion::lens::LensPoint;

/// A camera at one time, with a picture size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Transform from camera to world.
    pub to_world: DAffine3,
    to_camera: DAffine3,
    /// Focal length in pixels: half the picture's height over the tangent of half its angle.
    focal: f64,
    /// Half the picture's width and height in pixels.
    half: [f64; 2],
    /// Lens; none for a pinhole.
    lens: Option<Lens>,
}

/// The derivative of a [`View`] by time, per frame.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct ViewRate {
    /// Derivative of the transform from camera to world; its last row is zero.
    to_world: DAffine3,
    /// Derivative of the focal length, in pixels.
    focal: f64,
}

impl ViewRate {
    /// The rate of a camera that stands still.
    pub const STILL: Self = Self {
        to_world: DAffine3::ZERO,
        focal: 0.0,
    };

    /// The derivative of `view`, the camera's at `time` (frames), just before that time.
    pub fn before(camera: &Camera, time: f64, view: &View) -> Self {
        let fov_rate = camera.vertical_fov_rate_before(time);
        Self {
            to_world: camera.motion.rate_before(time),
            focal: -view.focal * fov_rate / camera.vertical_fov_at(time).sin(),
        }
    }

    pub fn is_still(&self) -> bool {
        *self == Self::STILL
    }
}

/// What a camera may see.
#[derive(Clone, Copy)]
pub(crate) enum Target {
    /// A point of the world.
    Point(DVec3),
    /// A point at infinity, in a direction of the world.
    Infinity(DVec3),
}

impl View {
    /// The view of a camera at `time` (frames), for a picture of `width` x `height` pixels.
    pub fn new(camera: &Camera, time: f64, width: u32, height: u32) -> Self {
        let to_world = camera.motion.at(time);
        let half = [0.5 * f64::from(width), 0.5 * f64::from(height)];
        Self {
            to_world,
            to_camera: to_world.inverse(),
            focal: half[1] / (0.5 * camera.vertical_fov_at(time)).tan(),
            half,
            lens: camera.lens,
        }
    }

    /// The ray through a point of the picture, in pixels from the top left, and the centre of the
    /// lens.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let direction = DVec3::new(x - self.half[0], self.half[1] - y, -self.focal);
        Ray {
            origin: self.to_world.translation,
            direction: self.to_world.transform_vector3(direction).normalize(),
        }
    }

    /// The ray through a point of the picture, in pixels from the top left, and a point of the
    /// lens. All rays through one point of the picture meet at the focus.
    pub(crate) fn ray_through(&self, place: [f64; 2], from: LensPoint) -> Ray {
        let Some(lens) = self.lens else {
            return self.ray(place[0], place[1]);
        };
        let [x, y] = [place[0] - self.half[0], self.half[1] - place[1]];
        let sharp = DVec3::new(x, y, -self.focal) * (lens.focus / self.focal);
        let start = from.0.extend(0.0);
        Ray {
            origin: self.to_world.transform_point3(start),
            direction: self.to_world.transform_vector3(sharp - start).normalize(),
        }
    }

    /// A point of the lens in the world.
    pub(crate) fn eye(&self, from: LensPoint) -> DVec3 {
        match self.lens {
            None => self.to_world.translation,
            Some(_) => self.to_world.transform_point3(from.0.extend(0.0)),
        }
    }

    /// Projects a target to pixels from the top left, through the centre of the lens; none behind
    /// the camera.
    pub(crate) fn project(&self, target: Target) -> Option<[f64; 2]> {
        let seen = match target {
            Target::Point(point) => self.to_camera.transform_point3(point),
            Target::Infinity(direction) => self.to_camera.transform_vector3(direction),
        };
        let depth = -seen.z;
        (depth > 0.0).then(|| {
            [
                self.half[0] + self.focal * seen.x / depth,
                self.half[1] - self.focal * seen.y / depth,
            ]
        })
    }

    /// The derivative of a target's projection and depth: pixels per frame, +x right, +y down, then
    /// metres per frame away from the camera. The target moves by `velocity` metres per frame in
    /// the world, and the view by `rate`. None behind the camera.
    pub(crate) fn velocity_of(
        &self,
        target: Target,
        velocity: DVec3,
        rate: &ViewRate,
    ) -> Option<[f64; 3]> {
        let (seen, relative) = match target {
            Target::Point(point) => {
                let seen = self.to_camera.transform_point3(point);
                (seen, velocity - rate.to_world.transform_point3(seen))
            }
            Target::Infinity(direction) => {
                let seen = self.to_camera.transform_vector3(direction);
                (seen, -rate.to_world.transform_vector3(seen))
            }
        };
        let seen_rate = self.to_camera.transform_vector3(relative);
        let depth = -seen.z;
        let across = |axis: usize| {
            let slope = seen_rate[axis] + seen[axis] * seen_rate.z / depth;
            (self.focal * slope + rate.focal * seen[axis]) / depth
        };
        let away = match target {
            Target::Point(_) => -seen_rate.z,
            Target::Infinity(_) => 0.0,
        };
        (depth > 0.0).then(|| [across(0), -across(1), away])
    }

    /// Projects a target through a point of the lens: the place whose ray through that point meets
    /// it.
    pub(crate) fn project_through(&self, target: Target, from: LensPoint) -> Option<DVec2> {
        let place = DVec2::from(self.project(target)?);
        let Some(lens) = self.lens else {
            return Some(place);
        };
        let inverse_depth = match target {
            Target::Point(point) => 1.0 / self.depth(point),
            Target::Infinity(_) => 0.0,
        };
        let shift = self.focal * (1.0 / lens.focus - inverse_depth) * from.0;
        Some(place + DVec2::new(shift.x, -shift.y))
    }

    /// The homography from this view's picture to `other`'s. Its three rows act on (x, y, 1, 1 /
    /// depth), in pixels and metres, and give (x', y', 1) times a common factor, which is positive
    /// in front of the camera.
    pub(crate) fn to_picture_of(self, other: &View) -> [[f64; 4]; 3] {
        let to_other = other.to_camera * self.to_world;
        // Half the picture and the focal length convert a place to a direction, and a direction to
        // a place.
        let [half_x, half_y] = self.half;
        let direction = |place: DVec3| {
            DVec3::new(
                place.x - half_x * place.z,
                half_y * place.z - place.y,
                -self.focal * place.z,
            ) / self.focal
        };
        let place = |seen: DVec3| {
            DVec3::new(
                other.focal * seen.x - other.half[0] * seen.z,
                -other.focal * seen.y - other.half[1] * seen.z,
                -seen.z,
            )
        };
        let columns = [DVec3::X, DVec3::Y, DVec3::Z]
            .map(|axis| place(to_other.transform_vector3(direction(axis))));
        let shift = place(to_other.translation);
        [0, 1, 2].map(|row| {
            [
                columns[0][row],
                columns[1][row],
                columns[2][row],
                shift[row],
            ]
        })
    }

    /// The camera as a frame records it.
    pub(crate) fn pose(&self) -> CameraPose {
        let columns = self.to_world.to_cols_array_2d();
        CameraPose {
            focal: self.focal,
            to_world: [0, 1, 2].map(|row| columns.map(|column| column[row])),
        }
    }

    /// Distance of a point of the world along the view axis, metres.
    pub fn depth(&self, point: DVec3) -> f64 {
        -self.to_camera.transform_point3(point).z
    }
}
