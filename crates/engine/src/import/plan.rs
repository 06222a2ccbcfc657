//! Plan of an import.

use std::path::PathBuf;

use measure::Error;
use scene::Family;

use crate::import::model::Up;

/// A model, and the scene to make of it.
pub struct ImportPlan {
    /// The OBJ file.
    pub model: PathBuf,
    /// The scene's folder, which does not exist yet.
    pub out: PathBuf,
    /// The model's axis that points up.
    pub up: Up,
    /// True to import the model in grey, without its materials.
    pub plain: bool,
    /// Motion of model and camera.
    pub motions: Motions,
    /// Exposure in frames.
    pub exposure: f64,
}

/// Speeds of model and camera; at least one is given.
#[derive(Clone, Copy, Debug, Default)]
pub struct Motions {
    /// Rotation of the stand, in degrees per frame.
    pub spin: Option<f64>,
    /// Motion of the stand to the right, in pixels per frame at the model's middle and 640x360.
    pub slide: Option<f64>,
    /// Motion of the camera around the model, in degrees per frame.
    pub orbit: Option<f64>,
}

impl Motions {
    /// Refuses a scene without motion.
    pub fn check(&self) -> Result<(), Error> {
        match (self.spin, self.slide, self.orbit) {
            (None, None, None) => Err(Error::Refused(
                "nothing would move; give one or more of a spin such as 20deg/frame, a slide such as 40px/frame, an orbit such as \
                 3deg/frame"
                    .to_owned(),
            )),
            _ => Ok(()),
        }
    }

    /// Returns the family of a scene with this motion.
    pub fn family(&self) -> Family {
        match (self.spin, self.slide) {
            (Some(_), _) => Family::Rotation,
            (None, Some(_)) => Family::Translation,
            (None, None) => Family::Camera,
        }
    }

    /// Describes the motion: `it turns 20 degrees per frame, and it slides 40 pixels per frame`.
    pub fn sentence(&self) -> String {
        let says = [
            self.spin
                .map(|speed| format!("it turns {speed} degrees per frame")),
            self.slide
                .map(|speed| format!("it slides {speed} pixels per frame")),
            (self.orbit)
                .map(|speed| format!("the camera goes around it by {speed} degrees per frame")),
        ];
        let says: Vec<String> = says.into_iter().flatten().collect();
        says.join(", and ")
    }
}
