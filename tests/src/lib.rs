//! What several integration tests share.

pub mod shapes;
pub mod statistics;
pub mod synthetic;
