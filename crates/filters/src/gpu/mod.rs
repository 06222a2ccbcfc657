//! Everything that names wgpu: adapters, the reflection of kernels, and the runner.

mod adapter;
mod binding;
mod blur;
mod clock;
mod copy;
mod demand;
mod iterations;
mod kernels;
mod limits;
mod loops;
mod nesting;
mod noise;
mod patience;
mod plan;
mod resident;
mod shader;
mod stack;
mod targets;
mod timing;
mod transfer;
mod uniforms;

pub use adapter::{AdapterDescription, Gpu, list_adapters};
pub use blur::Blur;
pub use clock::Clock;
pub use copy::BufferCopy;
pub use demand::{MAX_INLINED, MAX_INVOCATION_BYTES};
pub use kernels::Kernels;
pub use limits::Limits;
pub use loops::LoopLimit;
pub use nesting::MAX_NESTING;
pub use resident::Resident;
pub(crate) use shader::{EntryPoint, Role, Shader, Texel, written};
pub use targets::MAX_TEXTURE_BYTES;
pub use timing::{Loaded, PassTime};
