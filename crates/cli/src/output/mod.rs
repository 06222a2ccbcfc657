//! Everything that reaches a terminal, a log or a service that reads checks.

pub mod github;
pub mod junit;
pub mod paint;
pub mod progress;
pub mod wrapped;
