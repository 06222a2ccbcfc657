//! Motion blur filters on the GPU: a filter is a folder with `filter.toml` and one WGSL file.
//!
//! `shaders/README.md` says how to write one. The conventions of images, velocity, depth and time are those of the
//! [`frame`] crate.

mod error;
mod filter;
mod gpu;
mod manifest;
mod parameter;
mod reach;
mod settings;
mod wiring;

pub use error::FilterError;
pub use filter::{Filter, Format, Pass, Preset, Repeat, Texture};
pub use gpu::{
    AdapterDescription, Blur, BufferCopy, Clock, Gpu, Input, Loaded, PassTime, list_adapters,
};
pub use parameter::{Kind, Parameter, Scale, Value};
pub use reach::{Growth, Length, ReachBy};
pub use settings::Settings;
