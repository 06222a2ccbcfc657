//! Filters: folders, kernels, and shipped presets against their originals.

mod calibration;
mod camera_gather;
mod engine_filters;
mod engine_shaders;
mod fields;
mod filter_files;
mod folders;
mod invariants;
mod jump_flood_findings;
mod jump_flood_packed;
mod jump_flood_reference;
mod keys;
mod pass_times;
mod preset_sources;
mod reference;
mod tile_reference;
mod wrong_kernels;
