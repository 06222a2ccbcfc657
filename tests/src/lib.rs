//! Code that several integration tests share.

pub mod brute_force;
pub mod filter_folder;
pub mod half_plane;
pub mod kernels;
pub mod picture;
pub mod plate;
pub mod presets;
pub mod ramp;
pub mod random;
pub mod shapes;
pub mod statistics;
pub mod synthetic;
pub mod text;

use std::ops::ControlFlow;

use tracer::Progress;

/// A watcher that lets every render go on.
pub fn unwatched(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
