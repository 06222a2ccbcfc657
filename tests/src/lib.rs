//! What several integration tests share.

pub mod shapes;
pub mod synthetic;
