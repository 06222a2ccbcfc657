//! Origin of a rendered file.

use crate::FileError;
use crate::exr::ExrFile;

/// Scene, program and inputs of a rendered file, written into it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Scene name, with its variant: `sliding_panel` or `sliding_panel@64px_45deg`.
    pub scene: String,
    /// Program name and version.
    pub program: String,
    /// Seed of all randomness.
    pub seed: u64,
    /// Samples per pixel over all replicates.
    pub samples_per_pixel: u32,
    /// Number of independent, complete renders that were averaged.
    pub replicates: u32,
    /// Instructions that traced the rays, `avx2` or `portable`. Both find the same hits, so pixels
    /// do not depend on it.
    pub traversal: String,
    /// Hash of scene, meshes, textures, settings and the tracer, in hexadecimal: equal hashes mean
    /// equal pixels.
    pub content_hash: String,
    /// Engine that drew the pictures; its sub-frames then count as samples. None if rays were
    /// traced.
    pub engine: Option<String>,
}

impl Provenance {
    /// Returns whether a file was rendered from the inputs with this hash. False for a file that an
    /// engine drew, whatever its hash.
    pub fn is_rendered_of(&self, content_hash: &str) -> bool {
        self.content_hash == content_hash && self.engine.is_none()
    }

    /// Sets an attribute per field.
    pub fn set(&self, file: &mut ExrFile) {
        file.set("scene", &self.scene);
        file.set("program", &self.program);
        file.set("seed", self.seed);
        file.set("samples_per_pixel", self.samples_per_pixel);
        file.set("replicates", self.replicates);
        file.set("traversal", &self.traversal);
        file.set("content_hash", &self.content_hash);
        if let Some(engine) = &self.engine {
            file.set("engine", engine);
        }
    }

    pub(crate) fn from_exr(file: &ExrFile) -> Result<Self, FileError> {
        Ok(Self {
            scene: file.get("scene")?,
            program: file.get("program")?,
            seed: file.get("seed")?,
            samples_per_pixel: file.get("samples_per_pixel")?,
            replicates: file.get("replicates")?,
            traversal: file.get("traversal")?,
            content_hash: file.get("content_hash")?,
            engine: file.attributes.get("engine").cloned(),
        })
    }
}
