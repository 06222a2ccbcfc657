//! The camera of a frame and of the one before, for shaders that rebuild places in the world.

use crate::FileError;
use crate::exr::ExrFile;

/// The camera at the frame's instant and one frame before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// At the instant.
    pub now: CameraPose,
    /// One frame before.
    pub before: CameraPose,
}

/// A camera at one time. It looks along its own -z, with +y up, at the middle of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraPose {
    /// Focal length in pixels: half the picture's height over the tangent of half its angle.
    pub focal: f64,
    /// Rows of the transform from camera to world, in metres; it turns and moves, and never scales.
    pub to_world: [[f64; 4]; 3],
}

impl CameraPose {
    /// A camera at the world's origin that looks along -z.
    pub fn at_origin(focal: f64) -> Self {
        Self {
            focal,
            to_world: [
                [1.0, 0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
            ],
        }
    }
}

/// Attributes of the two times: a focal length and twelve numbers each.
const NAMES: [&str; 2] = ["camera", "camera_before"];

impl Camera {
    /// Makes a camera that stands still.
    pub fn still(pose: CameraPose) -> Self {
        Self {
            now: pose,
            before: pose,
        }
    }

    /// Sets the attributes `camera` and `camera_before`.
    pub fn set(&self, file: &mut ExrFile) {
        for (name, pose) in NAMES.into_iter().zip([self.now, self.before]) {
            let rows = pose.to_world.as_flattened().iter().copied();
            file.set_numbers(name, [pose.focal].into_iter().chain(rows));
        }
    }

    /// Reads the attributes `camera` and `camera_before`; `None` if the file has neither.
    pub fn from_exr(file: &ExrFile) -> Result<Option<Self>, FileError> {
        if !NAMES.iter().any(|name| file.attributes.contains_key(*name)) {
            return Ok(None);
        }
        let [now, before] = NAMES.map(|name| read_pose(file, name));
        Ok(Some(Self {
            now: now?,
            before: before?,
        }))
    }
}

fn read_pose(file: &ExrFile, name: &str) -> Result<CameraPose, FileError> {
    match file.numbers::<13>(name)? {
        Some([focal, rows @ ..]) if focal > 0.0 => Ok(CameraPose {
            focal,
            to_world: [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| rows[4 * row + column])),
        }),
        _ => Err(file.foreign(format!(
            "attribute \"{name}\" does not hold thirteen finite numbers: a focal length above 0 in pixels, and three rows \
             of four from camera to world"
        ))),
    }
}
