//! Text for terminals, logs and services that read checks.

mod adapter;
mod interrupts;
mod print;
mod progress;
mod text;
mod verbosity;
mod wrap;

pub use self::adapter::*;
pub use self::interrupts::*;
pub use self::print::*;
pub use self::progress::*;
pub use self::text::*;
pub use self::verbosity::*;
pub use self::wrap::*;
