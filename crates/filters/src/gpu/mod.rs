//! Everything that names wgpu: adapters, the reflection of kernels, and the runner.

mod adapter;
mod binding;
mod blur;
mod clock;
mod copy;
mod iterations;
mod kernels;
mod loops;
mod noise;
mod patience;
mod plan;
mod resident;
mod shader;
mod targets;
mod timing;
mod transfer;
mod uniforms;

pub use adapter::{AdapterDescription, Gpu, list_adapters};
pub use blur::Blur;
pub use clock::Clock;
pub use copy::BufferCopy;
pub use kernels::Kernels;
pub use loops::LoopLimit;
pub use resident::Resident;
pub(crate) use shader::{EntryPoint, Role, Shader, Texel, written};
pub use timing::{Loaded, PassTime};
