//! Text for terminals, logs and services that read checks.

mod adapter;
mod colors;
mod interrupts;
mod print;
mod progress;
mod verbosity;
mod wrap;

pub use self::adapter::*;
pub use self::colors::*;
pub use self::interrupts::*;
pub use self::print::*;
pub use self::progress::*;
pub use self::verbosity::*;
pub use self::wrap::*;
