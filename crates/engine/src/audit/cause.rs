//! Causes of wrong pictures: structures, conventions and fitted numbers.

use serde::Serialize;

/// Known cause of a wrong picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// Zero despite motion.
    Zero,
    /// Previous minus current.
    WrongSign,
    /// The y axis points the other way.
    FlippedY,
    /// The x axis points the other way.
    FlippedX,
    /// x and y are exchanged.
    SwappedAxes,
    /// The camera's motion alone.
    ObjectMotionMissing,
    /// The motion of the camera and of each object's parents.
    OwnMotionMissing,
    /// The motion without changes of shape.
    DeformationMissing,
    /// The object's own motion, without its parents'.
    ParentMotionMissing,
    /// The object's last matrix lacks its parents'.
    ParentMissing,
    /// The last place has the rest pose.
    RestPose,
    /// The objects' motion alone.
    CameraMotionMissing,
    /// The objects' motion and the camera's zoom, without the camera's own motion.
    ViewMissing,
    /// The camera's turn alone, as of things at infinity.
    CameraTurnAlone,
    /// All but the camera's zoom.
    ZoomMissing,
    /// The motion since two frames ago.
    TwoFrames,
    /// The objects' motion since two frames ago, with the camera's since the last frame.
    OlderMatrix,
    /// The motion from two frames ago to one frame ago.
    FrameLate,
    /// The objects' motion from two frames ago to one frame ago, with the camera's of now.
    LateMatrix,
    /// The whole buffer of the previous frame.
    PreviousBuffer,
    /// Stored where the previous frame showed the point.
    PreviousPixel,
    /// The motion to the next frame.
    FrameEarly,
    /// The object's last matrix was the identity.
    MatrixNeverSet,
    /// The object's last matrix is that of one of these objects, which have the same.
    MatrixOf(Vec<String>),
    /// The object's last matrix is that of one of these instances of its mesh, which have the same.
    MatrixOfInstance(Vec<String>),
    /// The object's last shape is the key shape at this time, in frames.
    OtherPose(f64),
    /// The object's last place is this far from the right one, in metres of the world.
    Teleport([f64; 3]),
    /// The motion at the instant, half a frame later than the mean motion since the previous frame.
    HalfFrameOff,
    /// Blocks of so many pixels on each side share a vector.
    LowResolution(u32),
    /// A factor on both axes.
    Scale(f64),
    /// A factor on each axis.
    ScaleOfAxes([f64; 2]),
    /// The same vector, in pixels, added to all.
    Offset([f64; 2]),
    /// An upper limit on the length, in pixels.
    Clipped(f64),
    /// A limit on each axis, in pixels.
    ClippedAxes(f64),
    /// Steps of this many pixels.
    Steps(f64),
    /// The motion over a part of a second instead of a frame of the exported animation: its
    /// denominator.
    MotionOver(f64),
    /// Rows from the bottom.
    UpsideDown,
    /// Shows the scene this many frames before the instant.
    DrawnLate(u32),
    /// Shows the scene this many frames after the instant.
    DrawnEarly(u32),
    /// A factor on radiance.
    Brightness(f64),
    /// Mean radiance of an object in the engine's picture, and the correct one.
    OtherColor([f64; 3], [f64; 3]),
    /// A factor on depth.
    DepthScale(f64),
    /// The distance along the ray, not along the view axis.
    DepthAlongRay,
    /// The near or far plane differs from the convention's: the true near plane is this many times
    /// as far.
    DepthPlanes(f64),
    /// The background's depth is only this many metres.
    DepthOfBackground(f64),
    /// The picture shows something else.
    OtherView,
    /// No known cause.
    Unknown,
}

/// Largest offset that jitter makes, in pixels on each axis: the places of two frames differ by up
/// to a pixel.
const LARGEST_JITTER: f64 = 1.0;

/// Causes that are variants of one mistake. Where they look the same, one of them is enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Family {
    /// A motion of objects is missing, in whole or in part.
    MissingMotion,
    /// The camera stands still.
    StillCamera,
    /// The motion is one frame late.
    Late,
    /// The last frame is an older one.
    Older,
    /// The buffer is smaller than the picture.
    LowResolution,
}

impl Cause {
    /// Applies a wrong sign, axis or unit to a vector; leaves it as it is for another cause.
    pub(super) fn apply(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let scaled = |part: f32, scale: f64| (f64::from(part) * scale) as f32;
        match self {
            Self::WrongSign => [-x, -y],
            Self::FlippedY => [x, -y],
            Self::FlippedX => [-x, y],
            Self::SwappedAxes => [y, x],
            Self::Scale(scale) => [scaled(x, *scale), scaled(y, *scale)],
            Self::ScaleOfAxes(scales) => [scaled(x, scales[0]), scaled(y, scales[1])],
            _ => [x, y],
        }
    }

    /// Returns whether the cause would be wrong on every object that moves: a unit, a sign or an
    /// axis.
    pub(super) fn is_of_convention(&self) -> bool {
        self.is_turn() || matches!(self, Self::Scale(_) | Self::ScaleOfAxes(_))
    }

    /// Returns whether the cause is a sign or an axis.
    pub(super) fn is_turn(&self) -> bool {
        matches!(
            self,
            Self::WrongSign | Self::FlippedY | Self::FlippedX | Self::SwappedAxes
        )
    }

    /// Returns the mistake that this one is a variant of, if there are several.
    pub(super) fn family(&self) -> Option<Family> {
        match self {
            Self::ObjectMotionMissing | Self::OwnMotionMissing | Self::ParentMotionMissing => {
                Some(Family::MissingMotion)
            }
            Self::CameraMotionMissing | Self::ViewMissing => Some(Family::StillCamera),
            Self::FrameLate | Self::LateMatrix => Some(Family::Late),
            Self::TwoFrames | Self::OlderMatrix => Some(Family::Older),
            Self::LowResolution(_) => Some(Family::LowResolution),
            _ => None,
        }
    }

    /// Returns whether the cause is an offset as small as jitter.
    pub(super) fn is_of_jitter(&self) -> bool {
        matches!(self, Self::Offset(offset) if offset.iter().all(|part| part.abs() <= LARGEST_JITTER))
    }

    /// Returns whether the cause is the unit of coordinates from -1 to 1 where it is of those from
    /// 0 to 1, or the reverse.
    pub(super) fn is_unit_of_two(&self) -> bool {
        matches!(self, Self::Scale(scale) if (scale - 2.0).abs() < 0.02 || (scale - 0.5).abs() < 0.005)
    }

    /// Returns whether the cause is a number that was fitted to the vectors, not a structure.
    pub(super) fn is_fitted(&self) -> bool {
        matches!(
            self,
            Self::Scale(_)
                | Self::ScaleOfAxes(_)
                | Self::Offset(_)
                | Self::Clipped(_)
                | Self::ClippedAxes(_)
                | Self::Steps(_)
        )
    }
}
