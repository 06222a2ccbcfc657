//! Code shared by several integration tests.

pub mod brute_force;
pub mod exr_attribute;
pub mod filter_folder;
mod gpu;
pub mod half_plane;
pub mod kernels;
pub mod limits;
pub mod near;
pub mod panel;
pub mod picture;
pub mod plate;
pub mod presets;
pub mod ramp;
pub mod random;
pub mod shapes;
pub mod smear;
pub mod statistics;
pub mod synthetic;
pub mod text;
pub mod vector;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use filters::Gpu;
pub use gpu::{ready_blur, shared_gpu};
use tracer::{Progress, RenderSettings};

/// Makes settings of a size and samples per pixel, those of a truth in 8 replicates.
pub fn settings([width, height]: [u32; 2], samples_per_pixel: u32) -> RenderSettings {
    RenderSettings {
        width,
        height,
        samples_per_pixel,
        ..RenderSettings::default()
    }
}

/// Makes settings of a truth in another number of replicates.
pub fn settings_of(size: [u32; 2], samples_per_pixel: u32, replicates: u32) -> RenderSettings {
    let common = settings(size, samples_per_pixel);
    RenderSettings {
        replicates,
        ..common
    }
}

/// Watches a render and lets it continue.
pub fn unwatched(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Opens the tests' adapter for filters, for a test that changes it, leaves it busy, or has no
/// other.
pub fn open_gpu() -> Gpu {
    Gpu::new(None).expect("these tests run filters")
}

/// Returns the folder of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Returns the folder of the shipped scenes.
pub fn scenes() -> PathBuf {
    root().join("scenes")
}
