//! WGSL, read by naga.

mod depth;
mod nesting;
mod source;

pub use source::WgslText;

use std::path::Path;

use naga::Module;

use crate::fault::FileFault;
use depth::read_depth_as_floats;

/// Reads WGSL without common.wgsl; its depth textures become textures of floats.
pub fn read(path: &Path, text: &str) -> Result<Module, FileFault> {
    let module = WgslText::new(path, text, "").parse()?;
    match read_depth_as_floats(&module, text) {
        Some(text) => WgslText::new(path, &text, "").parse(),
        None => Ok(module),
    }
}
