//! Validation of modules.

use naga::valid::{Capabilities, ValidationFlags, Validator};

/// Capabilities of every device; kernels can `enable` nothing more.
pub const CAPABILITIES: Capabilities = Capabilities::MULTISAMPLED_SHADING
    .union(Capabilities::CUBE_ARRAY_TEXTURES)
    .union(Capabilities::SHADER_FLOAT16_IN_FLOAT32);

/// Makes a validator of shaders that engines wrote, which may compute in 64 bits.
pub fn engine_validator() -> Validator {
    Validator::new(ValidationFlags::all(), CAPABILITIES | Capabilities::FLOAT64)
}
