//! Bounds, and what they notice; tuned presets.

mod bounds;
mod planted_defects;
mod shipped_bounds;
mod tuned_presets;
