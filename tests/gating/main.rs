//! Bounds, and presets that are tuned and held to them.

mod bounds;
mod planted_defects;
mod shipped_bounds;
mod tune;
mod tuned_presets;
