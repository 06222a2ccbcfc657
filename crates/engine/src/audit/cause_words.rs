//! Words of causes, and of their remedies.

use crate::audit::cause::Cause;
use crate::export::FRAMES_PER_SECOND;

/// Upper limit on the objects that a cause lists.
const MOST_NAMED: usize = 3;

impl Cause {
    /// Describes the mistake, as the continuation of a sentence.
    pub fn name(&self) -> String {
        (self.name_structure())
            .map(str::to_owned)
            .or_else(|| self.name_number())
            .unwrap_or_else(|| self.name_picture())
    }

    /// Describes the mistake of one object, while others are right.
    pub(super) fn name_on_object(&self) -> String {
        match self {
            Self::ObjectMotionMissing => "lacks its motion and that of its parents".to_owned(),
            Self::ParentMotionMissing => "lacks the motion of its parent".to_owned(),
            Self::OlderMatrix => "comes from its matrix of two frames ago".to_owned(),
            Self::Offset([x, y]) if self.is_of_jitter() => {
                format!(
                    "is off by ({x:+.3}, {y:+.3}) px, as of jitter in the pass that draws it (left in or removed twice) or of a bias"
                )
            }
            Self::Offset([x, y]) => {
                format!(
                    "is off by ({x:+.3}, {y:+.3}) px at every pixel: a bias, too long for jitter"
                )
            }
            _ => self.name(),
        }
    }

    /// Describes what is missing or in the wrong place; none for a number or another buffer.
    fn name_structure(&self) -> Option<&'static str> {
        Some(match self {
            Self::Zero => "is zero",
            Self::WrongSign => "has the wrong sign",
            Self::FlippedY => "has y flipped",
            Self::FlippedX => "has x flipped",
            Self::SwappedAxes => "has x and y swapped",
            Self::ObjectMotionMissing => "lacks the motion of objects",
            Self::OwnMotionMissing => "lacks its own motion",
            Self::DeformationMissing => "lacks the deformation",
            Self::ParentMotionMissing => "lacks the motion of parents",
            Self::ParentMissing => "comes from a last matrix without its parents'",
            Self::RestPose => {
                "comes from the rest pose (its first key), not from the pose of the frame before"
            }
            Self::CameraMotionMissing => {
                "lacks the motion of the camera: today's view and projection serve both frames"
            }
            Self::ViewMissing => {
                "lacks the motion of the camera, not its zoom: today's view serves both frames"
            }
            Self::CameraTurnAlone => "holds the camera's turn alone, as of things at infinity",
            Self::ZoomMissing => {
                "lacks the zoom of the camera: today's projection serves both frames"
            }
            Self::TwoFrames => "is the motion since two frames ago",
            Self::OlderMatrix => "comes from the objects' matrices of two frames ago",
            Self::FrameLate => "is one frame late",
            Self::LateMatrix => "has matrices and vertices that are one frame late",
            Self::PreviousBuffer => "is the whole buffer of the frame before",
            Self::PreviousPixel => "is taken at the previous pixel",
            Self::FrameEarly => "is one frame early",
            Self::MatrixNeverSet => "comes from a last matrix that was never set",
            Self::HalfFrameOff => {
                "is half a frame off: the motion at the instant, not since the frame before"
            }
            Self::UpsideDown => "has its rows upside down",
            Self::DepthAlongRay => "is the distance along the ray, not along the view axis",
            Self::OtherView => "shows other things, or shows them elsewhere",
            Self::Unknown => "is wrong in no known way",
            _ => return None,
        })
    }

    /// Describes a mistake of velocity with a number or a name; none for another buffer.
    fn name_number(&self) -> Option<String> {
        Some(match self {
            Self::MatrixOf(names) => {
                format!("comes from the last matrix of {}", list_names(names))
            }
            Self::MatrixOfInstance(names) => format!(
                "comes from the last matrix of {}, an instance of the same mesh",
                list_names(names)
            ),
            Self::OtherPose(time) => format!(
                "comes from its key shape at {time:+} frames, not from the shape of the frame before"
            ),
            Self::LowResolution(side) => {
                format!("has 1/{side} of the resolution: {side}x{side} pixels share a vector")
            }
            Self::Teleport([x, y, z]) => format!(
                "comes from elsewhere: its last place is off by ({x:+.3}, {y:+.3}, {z:+.3}) m, where no key has it"
            ),
            Self::Scale(_) if self.is_unit_of_two() => self.name_factor_of_two().to_owned(),
            Self::Scale(scale) => format!("is {scale:.3} times as long"),
            Self::ScaleOfAxes([x, y]) => format!("is {x:.3} times as long in x, {y:.3} times in y"),
            Self::Offset([x, y]) if self.is_of_jitter() => format!(
                "is off by ({x:+.3}, {y:+.3}) px everywhere: jitter is left in, or removed twice"
            ),
            Self::Offset([x, y]) => {
                format!("is off by ({x:+.3}, {y:+.3}) px everywhere: a bias, too long for jitter")
            }
            Self::Clipped(limit) => format!("is clipped at {limit:.1} px"),
            Self::ClippedAxes(limit) => format!("is clipped at {limit:.1} px on each axis"),
            Self::Steps(step) => format!("comes in steps of {step:.3} px, as of few bits"),
            Self::MotionOver(per_second) => format!(
                "is the motion over 1/{per_second} s, not over a frame, which is 1/{FRAMES_PER_SECOND} s of the exported animation"
            ),
            _ => return None,
        })
    }

    fn name_factor_of_two(&self) -> &'static str {
        match self {
            Self::Scale(scale) if *scale > 1.0 => "is twice too long",
            _ => "is half as long",
        }
    }

    /// Describes a mistake of another buffer with a number.
    fn name_picture(&self) -> String {
        match self {
            Self::DrawnLate(count) => format!("is drawn {} late", frames(*count)),
            Self::DrawnEarly(count) => format!("is drawn {} early", frames(*count)),
            Self::Brightness(scale) => format!("is {scale:.3} times as bright"),
            Self::OtherColor(mean, right) => {
                let [mean, right] = [mean, right]
                    .map(|[red, green, blue]| format!("({red:.3}, {green:.3}, {blue:.3})"));
                format!("is {mean} in the mean, not {right}")
            }
            Self::DepthScale(scale) => format!("is {scale:.4} times as large"),
            Self::DepthPlanes(factor) => {
                format!("fits a near plane that is {factor:.4} times as far as the convention's")
            }
            Self::DepthOfBackground(metres) => format!("of the background is {metres:.4} m"),
            _ => unreachable!("other causes have words"),
        }
    }

    /// Suggests a remedy, for one object or for the whole picture.
    pub(super) fn advice(&self, is_of_object: bool) -> Option<String> {
        let key = |text: &str| format!("if all of it is so, the convention may be wrong: {text}");
        match self {
            Self::WrongSign => Some(key("reverse `velocity_sign`")),
            Self::FlippedY => Some(key("reverse `velocity_y`")),
            Self::Scale(scale) => Some(key(&format!(
                "`velocity_scale` {scale:.3} times what it is would fit, or another unit in `velocity` or `velocity_per`"
            ))),
            Self::ScaleOfAxes(_) => {
                Some(key("another unit in `velocity` may fit: pixels, uv or ndc"))
            }
            Self::DepthScale(_) if is_of_object => None,
            Self::DepthScale(_) => Some(key("depth is in metres")),
            Self::Brightness(scale) => Some(key(&format!(
                "`color_scale` {scale:.3} times what it is would fit"
            ))),
            Self::DepthPlanes(_) => Some(key("give the camera's own `near` and `far`")),
            Self::DepthOfBackground(_) => Some(key(
                "leave `far` out if the engine's far plane is at infinity, or give the engine's own",
            )),
            _ => self.remedy().map(str::to_owned),
        }
    }

    /// Says what an engine must keep, or where to look.
    fn remedy(&self) -> Option<&'static str> {
        Some(match self {
            Self::OwnMotionMissing => {
                "keep the matrix of each object, and of each instance, for the frame after"
            }
            Self::DeformationMissing => "keep bones, morph weights or vertices for the frame after",
            Self::ParentMotionMissing | Self::ParentMissing => {
                "keep the object's matrix to the world, with its parents in it"
            }
            Self::RestPose | Self::OtherPose(_) => {
                "keep the bones, morph weights or vertices that the frame before was drawn with"
            }
            Self::CameraMotionMissing => {
                "keep the camera's view and projection for the frame after"
            }
            Self::ViewMissing => "keep the camera's view for the frame after",
            Self::CameraTurnAlone => {
                "draw the objects into the pass that writes velocity; their pixels have the background's"
            }
            Self::ZoomMissing => "keep the camera's projection for the frame after",
            Self::TwoFrames | Self::OlderMatrix => {
                "replace what is kept once in every frame, also in one that draws nothing new"
            }
            Self::LateMatrix => "update matrices and vertices before the pass that writes velocity",
            Self::MatrixNeverSet => "set the last matrix in an object's first frame",
            Self::MatrixOf(_) => "find the last matrix by the object, not by its place in a list",
            Self::MatrixOfInstance(_) => "keep the matrix of each instance for the frame after",
            Self::Teleport(_) => {
                "look for what else writes its last matrix, such as a jump or a reset"
            }
            Self::Offset(_) if self.is_of_jitter() => {
                "take the jitter of each frame from its own place, once, in every pass"
            }
            Self::OtherColor(..) => "check its materials and textures in the engine",
            Self::MotionOver(_) => {
                "draw the time `previous` of manifest.json first, then `instant`, and do not play the animation"
            }
            Self::LowResolution(_) => "write velocity in the size of the picture",
            Self::UpsideDown => "write the top row first",
            Self::DrawnLate(_) | Self::DrawnEarly(_) => "draw the time `instant` of manifest.json",
            Self::OtherView => "check camera, size, time and object ids before the vectors",
            _ => return None,
        })
    }
}

/// Lists objects with one matrix.
fn list_names(names: &[String]) -> String {
    let quoted = names.iter().take(MOST_NAMED);
    let quoted: Vec<String> = quoted.map(|name| format!("`{name}`")).collect();
    let further = names.len() - quoted.len();
    if further > 0 {
        return format!("{} or {further} more", quoted.join(", "));
    }
    quoted.join(" or ")
}

fn frames(count: u32) -> String {
    match count {
        1 => "one frame".to_owned(),
        _ => format!("{count} frames"),
    }
}
