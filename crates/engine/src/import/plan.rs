//! Plan of an import.

use std::path::PathBuf;

use measure::Error;
use scene::Family;

use crate::import::model::Up;

/// A model, and the scene to make of it.
pub struct ImportPlan {
    /// The OBJ file, or a folder of them, one per frame.
    pub model: PathBuf,
    /// Frames of the sequence that a folder of OBJ files shows.
    pub frames: u32,
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

impl ImportPlan {
    /// Returns whether the model is a folder, whose files are its motion.
    pub fn is_series(&self) -> bool {
        self.model.is_dir()
    }

    pub fn family(&self) -> Family {
        if self.is_series() {
            Family::Deforming
        } else {
            self.motions.family()
        }
    }

    /// Describes the motion: `it turns 20 degrees per frame, and it slides 40 pixels per frame`.
    pub fn sentence(&self) -> String {
        let shapes = self
            .is_series()
            .then(|| "it has a shape per frame".to_owned());
        let says: Vec<String> = shapes.into_iter().chain(self.motions.sentences()).collect();
        says.join(", and ")
    }
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

    /// Describes each motion.
    fn sentences(&self) -> impl Iterator<Item = String> {
        let says = [
            self.spin
                .map(|speed| format!("it turns {speed} degrees per frame")),
            self.slide
                .map(|speed| format!("it slides {speed} pixels per frame")),
            (self.orbit)
                .map(|speed| format!("the camera goes around it by {speed} degrees per frame")),
        ];
        says.into_iter().flatten()
    }
}
