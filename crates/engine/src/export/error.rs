//! Errors of an export.

use std::path::PathBuf;

use frame::FileError;

/// Failure of an export: place, what was found, what is allowed.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A file that could not be written or read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A texture that could not be encoded.
    #[error("{}: cannot encode: {reason}", path.display())]
    Texture {
        /// File to write.
        path: PathBuf,
        /// Reason.
        reason: String,
    },
    /// A translucent material that glTF cannot say.
    #[error(
        "material {material}: opacity {opacity} beside glass or a filter, which glTF 2.0 has no words for; it can say: glass or a \
         filter of opacity 0 without a texture of opacity, and a film without a filter; give the print on the glass a material of its own"
    )]
    Translucency {
        /// Name of the material.
        material: String,
        /// Its opacity.
        opacity: f32,
    },
    /// A field of view that changes, which glTF cannot say.
    #[error(
        "scene {scene}: the camera's field of view changes between frames {from} and {to}, which glTF 2.0 cannot animate; \
         export a scene or variant with one field of view"
    )]
    FieldOfView {
        /// Name of the scene.
        scene: String,
        /// First frame of the animation.
        from: f64,
        /// Last frame of the animation.
        to: f64,
    },
}
