//! What several integration tests share.

pub mod random;
pub mod shapes;
pub mod statistics;
pub mod synthetic;
