//! Kernels on an adapter: everything that runs on wgpu.

mod adapter;
mod binding;
mod blur;
mod bound_passes;
mod buffer_copy;
mod dependence;
mod device;
mod dispatch;
mod kernels;
mod levels;
mod limits;
mod loop_counts;
mod loop_probe;
mod matrices;
mod place;
mod rows;
mod targets;
mod timer;
mod timing;
mod transfer;
mod trial;
mod uniforms;
mod waiting;
mod wide_colors;

pub use adapter::list_adapters;
pub(crate) use binding::make_triangle;
pub use blur::Blur;
pub use buffer_copy::BufferCopy;
pub use device::{AdapterDescription, Clock, Gpu, LoopLimit};
pub use kernels::Kernels;
pub use limits::Limits;
pub(crate) use targets::{list_target_formats, output_format};
pub use timing::{LoadedBlur, PassTime};
pub use trial::try_out;
pub(crate) use uniforms::FrameValues;
