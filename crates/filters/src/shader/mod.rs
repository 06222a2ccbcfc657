//! Kernels of a filter, read without an adapter: their declarations, and what they ask of a device.

mod block;
mod compiled_by;
mod declarations;
mod divergence;
mod entry_point;
mod loop_counter;
mod member;
mod noise;
mod operands;
mod resource_usage;
mod sampling;
mod stack;
mod storage_formats;
mod texel;
mod variable;
mod varying;

pub(crate) use block::{BlockNumber, UniformBlock};
pub(crate) use compiled_by::try_each;
pub(crate) use declarations::{COMMON, Shader, hash_code};
pub(crate) use entry_point::{EntryPoint, find_entry_points};
pub(crate) use loop_counter::count_loop_iterations;
pub(crate) use member::{Member, NumberKind, list_members, name_element};
pub(crate) use sampling::{SamplerFilter, Sampling, Wrap};
pub(crate) use stack::{guard, run_on_large_stack};
pub use texel::Format;
pub(crate) use variable::{FRAME_PREFIX, Role, Variable, find_image_role, written_texture};
pub(crate) use varying::{Varying, follow_interpolation};
