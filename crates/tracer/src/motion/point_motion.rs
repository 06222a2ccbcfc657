//! Motion and points of a velocity buffer.

use frame::Size;
use scene::Scene;

use crate::motion::view::{View, ViewRate};

/// Motion and points of a velocity buffer: the right ones, or a broken buffer's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion {
    /// Time at which the points are seen at the pixels' centres, in frames.
    pub seen_at: f64,
    /// Time of the motion, in frames.
    pub moved_at: f64,
    /// Time since the place before, in frames; below 0 up to the place after.
    pub over: f64,
    /// True if the camera stands still.
    pub camera_stands: bool,
    /// Place of the objects one frame earlier.
    pub objects_before: ObjectsBefore,
    /// True if meshes keep their shape of the time of the motion.
    pub shapes_stand: bool,
    /// True if movers show through everything that stands still, as without a depth test.
    pub through_walls: bool,
}

impl PointMotion {
    /// The right motion.
    pub const RIGHT: Self = Self {
        seen_at: 0.0,
        moved_at: 0.0,
        over: 1.0,
        camera_stands: false,
        objects_before: ObjectsBefore::Own,
        shapes_stand: false,
        through_walls: false,
    };
    /// The right motion, with movers in front of what hides them.
    pub const THROUGH_WALLS: Self = Self {
        through_walls: true,
        ..Self::RIGHT
    };
    /// Each point's motion from two frames ago to one frame ago.
    pub const FRAME_LATE: Self = Self {
        moved_at: -1.0,
        ..Self::RIGHT
    };
    /// Each point's motion to the next frame.
    pub const FRAME_EARLY: Self = Self {
        moved_at: 1.0,
        ..Self::RIGHT
    };
    /// The motion to the next frame, of points that are followed from now.
    pub(crate) const TO_NEXT: Self = Self {
        over: -1.0,
        ..Self::RIGHT
    };
    /// The whole buffer of the frame before.
    pub const PREVIOUS_BUFFER: Self = Self {
        seen_at: -1.0,
        ..Self::FRAME_LATE
    };
    /// The right motion at the place where the frame before showed the point.
    pub const PREVIOUS_PIXEL: Self = Self {
        seen_at: -1.0,
        ..Self::RIGHT
    };
    /// The camera's motion alone.
    pub const WITHOUT_OBJECTS: Self = Self {
        objects_before: ObjectsBefore::Now,
        ..Self::RIGHT
    };
    /// The motion of the camera and of each object's parents.
    pub const WITHOUT_OWN: Self = Self {
        objects_before: ObjectsBefore::WithParents,
        ..Self::RIGHT
    };
    /// The motion without changes of shape.
    pub const WITHOUT_SHAPES: Self = Self {
        shapes_stand: true,
        ..Self::RIGHT
    };
    /// The objects' motion alone.
    pub const WITHOUT_CAMERA: Self = Self {
        camera_stands: true,
        ..Self::RIGHT
    };
    /// Objects come from the origin: their last matrix was never set.
    pub const MATRIX_NEVER_SET: Self = Self {
        objects_before: ObjectsBefore::Identity,
        ..Self::RIGHT
    };

    /// The view at the time of the motion, and its derivative just before.
    pub(super) fn view(&self, scene: &Scene, Size { width, height }: Size) -> (View, ViewRate) {
        let view = View::new(&scene.camera, self.moved_at, width, height);
        let rate = if self.camera_stands {
            ViewRate::STILL
        } else {
            ViewRate::before(&scene.camera, self.moved_at, &view)
        };
        (view, rate)
    }

    /// The times of a point's shape, its object and that object's parents when the camera is at
    /// `time`.
    pub(super) fn times(&self, time: f64) -> [f64; 3] {
        let now = self.moved_at;
        let [shape, object, parents] = match self.objects_before {
            ObjectsBefore::Own | ObjectsBefore::Identity => [time; 3],
            ObjectsBefore::Now => [now; 3],
            ObjectsBefore::WithParents => [now, now, time],
        };
        [if self.shapes_stand { now } else { shape }, object, parents]
    }
}

/// Place of the objects one frame earlier, as an engine knows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjectsBefore {
    /// Their own.
    Own,
    /// Their place now, as if they stood still.
    Now,
    /// Their place and shape now relative to their parents, which move.
    WithParents,
    /// No place: their matrix is still the identity, so that they were at the origin, not turned
    /// and not scaled.
    Identity,
}
