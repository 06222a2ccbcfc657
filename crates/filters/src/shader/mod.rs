//! Kernels of a filter, read without an adapter: their declarations, and what they ask of a device.

mod declarations;
mod entry_point;
mod loop_counter;
mod nesting;
mod noise;
mod resource_usage;
mod source;
mod stack;
mod texel;
mod uniform;
mod variable;

pub(crate) use declarations::Shader;
pub(crate) use entry_point::EntryPoint;
pub(crate) use loop_counter::count_loop_iterations;
pub use nesting::MAX_NESTING;
pub use resource_usage::{MAX_INLINED, MAX_INVOCATION_BYTES};
pub(crate) use stack::run_on_large_stack;
pub use texel::Format;
pub(crate) use texel::Texel;
pub(crate) use variable::{Role, Variable, written_texture};
