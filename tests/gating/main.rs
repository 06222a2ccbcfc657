//! Bounds, tuning, and tuned presets.

mod bounds;
mod planted_defects;
mod shipped_bounds;
mod tune;
mod tuned_presets;
