//! Shaders of engines, read as modules of naga.
//!
//! | folder | from | to |
//! |---|---|---|
//! | `glsl` | GLSL of Vulkan, OpenGL, Godot | SPIR-V, by glslangValidator |
//! | `hlsl` | HLSL, Unreal's, Unity's ShaderLab | SPIR-V, by slangc, dxc or glslangValidator |
//! | `slang` | Slang | SPIR-V, by slangc |
//! | `wesl` | WESL | WGSL, by wesl |
//! | `includes` | a shader and the files that it includes | copies for a compiler |
//! | `compile` | copies | the output of a compiler, run in a folder of its own |
//! | `spirv` | SPIR-V | a module of naga |
//! | `wgsl` | WGSL | a module of naga |
//! | `import` | all of the above in order: [`Import::compile`], then [`read`] | |
//!
//! The crate knows no filter: what filter.toml says comes as a [`ShaderFile`], and `filters` binds
//! the variables of the module. naga recurses and may panic on a hostile module, so callers use a
//! thread with a large stack, and catch panics.

mod compile;
mod compiler;
mod entry_point;
mod fault;
mod glsl;
mod hlsl;
mod import;
mod includes;
mod language;
mod naga_error;
mod open_module;
mod shader_file;
mod slang;
mod sources;
mod spirv;
mod validation;
mod wesl;
mod wgsl;

pub use compiler::Compiler;
pub use entry_point::{keep_entry_point, validate};
pub use fault::{FileFault, ImportError};
pub use import::{IdleName, Import, find_idle_name, read};
pub use includes::stays_below;
pub use language::{Language, SHADER_LAB};
pub use open_module::{OpenModule, PUSH_CONSTANTS};
pub use shader_file::{LabPass, Pictures, ShaderFile, Stage};
pub use sources::{MAX_MODULE_BYTES, ReadFile};
pub use spirv::{FindFormat, falls_through_wrongly};
pub use validation::engine_validator;
pub use wgsl::WgslText;
