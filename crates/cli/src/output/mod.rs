//! Text for terminals, logs and services that read checks.

pub mod colors;
pub mod count;
pub mod interrupts;
pub mod print;
pub mod progress;
pub mod verbosity;
pub mod wrap;
