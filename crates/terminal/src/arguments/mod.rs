//! Arguments that commands share.

mod frame_rates;
mod hinted;
mod input_forms;
mod measure;
mod parse;
mod programs;
mod run_options;
mod scenes;
mod scenes_root;

pub use self::frame_rates::*;
pub use self::hinted::*;
pub use self::input_forms::*;
pub use self::measure::*;
pub use self::parse::*;
pub use self::programs::*;
pub use self::run_options::*;
pub use self::scenes::*;
pub use self::scenes_root::*;
