//! A filter as data, and the settings that it runs with.

mod command;
mod convention;
mod conversion;
mod definition;
mod history;
mod layer;
mod notes;
mod parameter;
mod pass;
mod pass_shader;
mod placeholders;
mod preset;
mod reach;
mod settings;
mod values;

pub use command::Command;
pub use convention::{
    Convention, DepthKind, Origin, VelocitySign, VelocityTime, VelocityUnit, VerticalDirection,
};
pub use definition::Filter;
pub(crate) use definition::{DEFAULT_TIME_LIMIT, Lines};
pub use history::History;
pub use layer::{EXCLUSION, Layer};
pub use parameter::{Kind, Parameter, Scale, Unit, Value};
pub(crate) use pass::{Count, Pass, Rounding};
pub use pass::{Holds, Texture};
pub(crate) use pass_shader::{Binding, BindingPlace, PassShader, VertexShader};
pub(crate) use placeholders::{PLACEHOLDERS, fill_placeholders};
pub use preset::{Code, Preset, Source, TuningRecord};
pub use reach::ReachBy;
pub use settings::Settings;
pub(crate) use values::{
    CameraUse, MATRICES, MATRIX_NUMBERS, explain_unknown, find_matrix, split_element,
};
