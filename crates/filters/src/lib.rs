//! Motion blur filters: a filter is a folder with `filter.toml` and one WGSL file, with shaders of an engine, or with the command
//! of a program that blurs files.
//!
//! `shaders/README.md` says how to write one. The conventions of images, velocity, depth and time are those of the
//! [`frame`] crate.
//!
//! | room | holds |
//! |---|---|
//! | `filter` | a filter as data: parameters, presets, passes, and the settings that it runs with |
//! | `shader` | declarations and costs of WGSL kernels, found without an adapter |
//! | `translate` | shaders in other languages, translated and bound as `filter.toml` says |
//! | `manifest` | the parser of `filter.toml` |
//! | `load` | loading: manifest and kernels of a folder, checked against each other |
//! | `gpu` | running kernels on an adapter |
//! | `command` | running programs |

mod command;
mod error;
mod expression;
mod filter;
mod gpu;
mod input;
mod load;
mod manifest;
mod printable;
mod shader;
mod translate;

pub use command::{BESIDE_PIXELS, BYTES_PER_PIXEL, CommandBlur};
pub use error::FilterError;
pub use expression::{Expression, Function};
pub use filter::{
    Binding, BindingPlace, Code, Command, Convention, DepthKind, Filter, Growth, History, Holds,
    Kind, Length, Parameter, Pass, PassShader, Preset, ReachBy, Repeat, Rounding, Scale, Settings,
    Source, Stage, Texture, TuningRecord, Unit, Value, VelocitySign, VelocityTime, VelocityUnit,
    VertexShader, VerticalDirection,
};
pub use gpu::{
    AdapterDescription, Blur, BufferCopy, Clock, Gpu, Kernels, Limits, LoadedBlur, LoopLimit,
    MAX_TEXTURE_BYTES, PassTime, UploadedInput, list_adapters, try_out,
};
pub use input::Input;
pub use load::{MAX_KERNEL_BYTES, MAX_MANIFEST_BYTES};
pub use manifest::{MAX_CHOICES, MAX_DISPATCHES, MAX_ENTRIES, MAX_MIPS};
pub use shader::{
    Format, MAX_INLINED, MAX_INVOCATION_BYTES, MAX_NESTING, SamplerFilter, Sampling, Wrap,
};
