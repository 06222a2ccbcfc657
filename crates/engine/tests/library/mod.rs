//! The library: audits of honest and planted frames, and exported scenes played back. A part of
//! tests/scenes.

mod audit;
mod audit_self;
mod gltf;
