//! Bounds and tuning.

mod bounds;
mod frame_noise;
mod planted_defects;
mod shipped_bounds;
#[path = "../../crates/tune/tests/library/mod.rs"]
mod tune;
