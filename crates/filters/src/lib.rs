//! Motion blur filters: a filter is a folder with `filter.toml` and one WGSL file, with shaders of
//! an engine, or with the command of a program that blurs files.
//!
//! `shaders/README.md` says how to write one. Images, velocity, depth and time follow the
//! conventions of the [`frame`] crate.
//!
//! | module | contents |
//! |---|---|
//! | `filter` | a filter as data: parameters, presets, passes, and the settings that it runs with |
//! | `shader` | declarations and costs of WGSL kernels, found without an adapter |
//! | `bind` | shaders of engines, imported by `shader_import`, and bound as `filter.toml` says |
//! | `manifest` | the parser of `filter.toml` |
//! | `load` | loading: manifest and kernels of a folder, checked against each other |
//! | `gpu` | running kernels on an adapter |
//! | `live` | a filter as data, for pages that run it in a browser |
//! | `command` | running programs |

mod bind;
mod command;
mod error;
mod expression;
mod filter;
mod gpu;
mod input;
mod live;
mod load;
mod manifest;
mod one_line;
mod shader;

pub use command::CommandBlur;
pub use error::FilterError;
pub(crate) use expression::Expression;
pub use filter::{
    Code, Command, Convention, DepthKind, EXCLUSION, Filter, History, Holds, Kind, Layer, Origin,
    Parameter, Preset, ReachBy, Scale, Settings, Source, Texture, TuningRecord, Unit, Value,
    VelocitySign, VelocityTime, VelocityUnit, VerticalDirection,
};
pub(crate) use filter::{Count, Pass, Rounding};
pub use gpu::{
    AdapterDescription, Blur, BufferCopy, Clock, Gpu, Kernels, Limits, LoadedBlur, LoopLimit,
    PassTime, list_adapters, try_out,
};
pub use input::Input;
pub use manifest::check_filter_name;
pub use shader::Format;
