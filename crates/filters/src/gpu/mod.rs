//! Everything that names wgpu: adapters, the reflection of kernels, and the runner.

mod adapter;
mod blur;
mod plan;
mod shader;
mod transfer;

pub use adapter::{AdapterDescription, Gpu, list_adapters};
pub use blur::{Blur, Input};
pub(crate) use shader::{EntryPoint, Role, Shader};
