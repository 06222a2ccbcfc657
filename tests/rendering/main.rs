//! Rendering: frames and truths against known answers, and their files.

mod at_instant;
mod coverage;
mod deforming;
mod determinism;
mod fast_motion;
mod files;
mod frame_variants;
mod furnace;
mod instances;
mod intersection;
mod lens;
mod materials;
mod motion;
mod moving_shapes;
mod pixel_grid;
mod regions;
mod renders;
mod shutter;
mod tiles;
mod translucency;
mod truth;
mod velocity;
