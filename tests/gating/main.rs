//! Bounds, tuning, and tuned presets.

mod bounds;
mod frame_noise;
mod planted_defects;
mod shipped_bounds;
mod tune;
mod tuned_presets;
