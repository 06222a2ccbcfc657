//! Plan of an import.

use std::path::PathBuf;

use crate::import::model::Up;
use crate::import::motion::Motions;

/// A model, and the scene to make of it.
pub struct ImportPlan {
    /// The OBJ file.
    pub model: PathBuf,
    /// The scene's folder, which does not exist yet.
    pub out: PathBuf,
    /// The model's axis that points up.
    pub up: Up,
    /// True to leave the model's materials out: it is grey.
    pub plain: bool,
    /// Motion of model and camera.
    pub motions: Motions,
    /// Exposure in frames.
    pub exposure: f64,
}
