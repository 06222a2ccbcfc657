//! Results as text, in 80 columns.

pub mod bench;
pub mod cases;
pub mod check;
pub mod comparison;
pub mod failures;
pub mod means;
pub mod sensitivity;
pub mod tuning;
