//! The library: known answers for every decision, and the tuned presets. A part of tests/gating.

mod deciding;
mod searching;
mod tuned_presets;
