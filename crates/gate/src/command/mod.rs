//! The commands `check`, `limits accept` and `limits calibrate`.

pub mod accept;
pub mod calibrate;
pub mod check;
