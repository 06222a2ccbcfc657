//! Plan of an import of glTF.

use std::path::PathBuf;

/// A file, and the scene to make of it.
pub struct GltfPlan {
    /// The `.gltf` or `.glb` file.
    pub model: PathBuf,
    /// The scene's folder, which does not exist yet.
    pub out: PathBuf,
    /// Seconds of the animation at the instant; by default its middle.
    pub time: Option<f64>,
    /// Frames per second.
    pub rate: f64,
    /// Frames of the sequence that the keys are for.
    pub frames: u32,
    /// Names of the animations that play together; by default the first alone.
    pub animations: Vec<String>,
    /// Name of the camera; by default the first.
    pub camera: Option<String>,
    /// Degrees per frame by which a camera goes around the model.
    pub orbit: Option<f64>,
    /// Exposure in frames.
    pub exposure: f64,
}
