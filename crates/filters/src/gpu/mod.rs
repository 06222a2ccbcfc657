//! Everything that names wgpu: adapters, the reflection of kernels, and the runner.

mod adapter;
mod binding;
mod blur;
mod plan;
mod shader;
mod targets;
mod transfer;
mod uniforms;

pub use adapter::{AdapterDescription, Gpu, list_adapters};
pub use blur::Blur;
pub(crate) use shader::{EntryPoint, Role, Shader, written};
