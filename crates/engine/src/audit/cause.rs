//! Causes of wrong pictures, in words.

use serde::Serialize;

use crate::export::FRAMES_PER_SECOND;

/// Known cause of a wrong picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
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
    /// The objects' motion alone.
    CameraMotionMissing,
    /// The motion from two frames ago to one frame ago.
    FrameLate,
    /// The whole buffer of the previous frame.
    PreviousBuffer,
    /// Stored where the previous frame showed the point.
    PreviousPixel,
    /// The motion to the next frame.
    FrameEarly,
    /// The object's last matrix was the identity.
    MatrixNeverSet,
    /// The motion at the instant, half a frame later than the mean motion since the previous frame.
    HalfFrameOff,
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

impl Cause {
    /// Applies a wrong sign, axis or unit to a vector; leaves it as it is for another cause.
    pub(super) fn apply(self, [x, y]: [f32; 2]) -> [f32; 2] {
        let scaled = |part: f32, scale: f64| (f64::from(part) * scale) as f32;
        match self {
            Self::WrongSign => [-x, -y],
            Self::FlippedY => [x, -y],
            Self::FlippedX => [-x, y],
            Self::SwappedAxes => [y, x],
            Self::Scale(scale) => [scaled(x, scale), scaled(y, scale)],
            Self::ScaleOfAxes(scales) => [scaled(x, scales[0]), scaled(y, scales[1])],
            _ => [x, y],
        }
    }

    /// Describes the mistake, as the continuation of a sentence.
    pub fn name(self) -> String {
        match self {
            Self::Zero => "is zero".to_owned(),
            Self::WrongSign => "has the wrong sign".to_owned(),
            Self::FlippedY => "has y flipped".to_owned(),
            Self::FlippedX => "has x flipped".to_owned(),
            Self::SwappedAxes => "has x and y swapped".to_owned(),
            Self::ObjectMotionMissing => "lacks the motion of objects".to_owned(),
            Self::OwnMotionMissing => "lacks its own motion".to_owned(),
            Self::DeformationMissing => "lacks the deformation".to_owned(),
            Self::CameraMotionMissing => "lacks the motion of the camera".to_owned(),
            Self::FrameLate => "is one frame late".to_owned(),
            Self::PreviousBuffer => "is the whole buffer of the frame before".to_owned(),
            Self::PreviousPixel => "is taken at the previous pixel".to_owned(),
            Self::FrameEarly => "is one frame early".to_owned(),
            Self::MatrixNeverSet => "comes from a last matrix that was never set".to_owned(),
            Self::HalfFrameOff => {
                "is half a frame off: the motion at the instant, not since the frame before"
                    .to_owned()
            }
            Self::Scale(scale) if (scale - 2.0).abs() < 0.02 => "is twice too long".to_owned(),
            Self::Scale(scale) if (scale - 0.5).abs() < 0.005 => "is half as long".to_owned(),
            Self::Scale(scale) => format!("is {scale:.3} times as long"),
            Self::ScaleOfAxes([x, y]) => format!("is {x:.3} times as long in x, {y:.3} times in y"),
            Self::Offset([x, y]) => {
                format!("is off by ({x:+.3}, {y:+.3}) px everywhere: jitter is left in")
            }
            Self::Clipped(limit) => format!("is clipped at {limit:.1} px"),
            Self::ClippedAxes(limit) => format!("is clipped at {limit:.1} px on each axis"),
            Self::Steps(step) => format!("comes in steps of {step:.3} px, as of few bits"),
            Self::MotionOver(per_second) => format!(
                "is the motion over 1/{per_second} s, not over a frame, which is 1/{FRAMES_PER_SECOND} s of the exported animation"
            ),
            Self::UpsideDown => "has its rows upside down".to_owned(),
            Self::DrawnLate(count) => format!("is drawn {} late", frames(count)),
            Self::DrawnEarly(count) => format!("is drawn {} early", frames(count)),
            Self::Brightness(scale) => format!("is {scale:.3} times as bright"),
            Self::OtherColor(mean, right) => {
                let [mean, right] = [mean, right]
                    .map(|[red, green, blue]| format!("({red:.3}, {green:.3}, {blue:.3})"));
                format!("is {mean} in the mean, not {right}")
            }
            Self::DepthScale(scale) => format!("is {scale:.4} times as large"),
            Self::DepthAlongRay => {
                "is the distance along the ray, not along the view axis".to_owned()
            }
            Self::DepthPlanes(factor) => {
                format!("fits a near plane that is {factor:.4} times as far as the convention's")
            }
            Self::DepthOfBackground(metres) => format!("of the background is {metres:.4} m"),
            Self::OtherView => "shows other things, or shows them elsewhere".to_owned(),
            Self::Unknown => "is wrong in no known way".to_owned(),
        }
    }

    /// Describes the mistake of one object, while others are right.
    pub(super) fn name_on_object(self) -> String {
        match self {
            Self::ObjectMotionMissing => "lacks its motion and that of its parents".to_owned(),
            Self::Offset([x, y]) => {
                format!("is off by ({x:+.3}, {y:+.3}) px, as of jitter in the pass that draws it")
            }
            _ => self.name(),
        }
    }

    /// Returns whether the cause would be wrong on every object that moves: a unit, a sign or an
    /// axis.
    pub(super) fn is_of_convention(self) -> bool {
        matches!(
            self,
            Self::WrongSign
                | Self::FlippedY
                | Self::FlippedX
                | Self::SwappedAxes
                | Self::Scale(_)
                | Self::ScaleOfAxes(_)
        )
    }

    /// Returns whether a motion of objects is missing, in whole or in part.
    pub(super) fn is_missing_motion(self) -> bool {
        matches!(
            self,
            Self::ObjectMotionMissing | Self::OwnMotionMissing | Self::DeformationMissing
        )
    }

    pub(super) fn is_offset(self) -> bool {
        matches!(self, Self::Offset(_))
    }

    /// Returns whether the cause is a word, without a fitted number.
    pub(super) fn is_word(self) -> bool {
        !matches!(
            self,
            Self::Scale(_)
                | Self::ScaleOfAxes(_)
                | Self::Offset(_)
                | Self::Clipped(_)
                | Self::ClippedAxes(_)
                | Self::Steps(_)
        )
    }

    /// Suggests a remedy, for one object or for the whole picture.
    pub(super) fn advice(self, is_of_object: bool) -> Option<String> {
        let key = |text: &str| {
            Some(format!(
                "if all of it is so, the convention may be wrong: {text}"
            ))
        };
        match self {
            Self::WrongSign => key("reverse `velocity_sign`"),
            Self::FlippedY => key("reverse `velocity_y`"),
            Self::Scale(scale) => key(&format!(
                "`velocity_scale` {:.3} times what it is would fit, or another unit in `velocity` or `velocity_per`",
                scale
            )),
            Self::ScaleOfAxes(_) => key("another unit in `velocity` may fit: pixels, uv or ndc"),
            Self::DepthScale(_) if is_of_object => None,
            Self::DepthScale(_) => key("depth is in metres"),
            Self::Brightness(scale) => key(&format!(
                "`color_scale` {scale:.3} times what it is would fit"
            )),
            Self::OwnMotionMissing => Some(
                "keep the matrix of each object, and of each instance, for the frame after".to_owned(),
            ),
            Self::DeformationMissing => Some(
                "keep bones, morph weights or vertices for the frame after".to_owned(),
            ),
            Self::OtherColor(..) => {
                Some("check its materials and textures in the engine".to_owned())
            }
            Self::MotionOver(_) => Some(
                "draw the time `previous` of manifest.json first, then `instant`, and do not play the animation".to_owned(),
            ),
            Self::UpsideDown => Some("write the top row first".to_owned()),
            Self::DrawnLate(_) | Self::DrawnEarly(_) => {
                Some("draw the time `instant` of manifest.json".to_owned())
            }
            Self::DepthPlanes(_) => key("give the camera's own `near` and `far`"),
            Self::DepthOfBackground(_) => key(
                "leave `far` out if the engine's far plane is at infinity, or give the engine's own; linear depth of nothing is infinite",
            ),
            Self::OtherView => {
                Some("check camera, size, time and object ids before the vectors".to_owned())
            }
            _ => None,
        }
    }
}

fn frames(count: u32) -> String {
    match count {
        1 => "one frame".to_owned(),
        _ => format!("{count} frames"),
    }
}
