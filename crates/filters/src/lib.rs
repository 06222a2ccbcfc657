//! Motion blur filters on the GPU: a filter is a folder with `filter.toml` and one WGSL file, or with the command of a
//! program that blurs files.
//!
//! `shaders/README.md` says how to write one. The conventions of images, velocity, depth and time are those of the
//! [`frame`] crate.

mod command;
mod error;
mod filter;
mod gpu;
mod input;
mod manifest;
mod parameter;
mod reach;
mod settings;
mod source;
mod text;
mod trial;
mod tuned;
mod wiring;

pub use command::{BESIDE_PIXELS, BYTES_PER_PIXEL, Command, CommandBlur};
pub use error::FilterError;
pub use filter::{
    Filter, Format, Holds, MAX_KERNEL_BYTES, MAX_MANIFEST_BYTES, Pass, Preset, Repeat, Texture,
};
pub use gpu::{
    AdapterDescription, Blur, BufferCopy, Clock, Gpu, Kernels, Limits, Loaded, LoopLimit,
    MAX_INLINED, MAX_INVOCATION_BYTES, MAX_NESTING, MAX_TEXTURE_BYTES, PassTime, Resident,
    list_adapters,
};
pub use input::Input;
pub use manifest::{MAX_CHOICES, MAX_DISPATCHES, MAX_ENTRIES};
pub use parameter::{Kind, Parameter, Scale, Unit, Value};
pub use reach::{Growth, Length, ReachBy};
pub use settings::Settings;
pub use source::{Code, Source};
pub use trial::try_out;
pub use tuned::Tuned;
