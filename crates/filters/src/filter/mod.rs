//! A filter as data, and the settings that it runs with.

mod command;
mod definition;
mod lines;
mod parameter;
mod pass;
mod placeholders;
mod preset;
mod reach;
mod settings;

pub use command::Command;
pub(crate) use definition::DEFAULT_TIME_LIMIT;
pub use definition::Filter;
pub(crate) use lines::Lines;
pub use parameter::{Kind, Parameter, Scale, Unit, Value};
pub use pass::{Holds, Pass, Repeat, Texture};
pub(crate) use placeholders::{PLACEHOLDERS, fill_placeholders};
pub use preset::{Code, Preset, Source, TuningRecord};
pub use reach::{Growth, Length, ReachBy};
pub use settings::Settings;
