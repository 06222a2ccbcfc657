//! Bounding volume hierarchies of triangles and boxes, and rays through them.
//!
//! [obvhs](https://docs.rs/obvhs) builds binary trees. This crate collapses them into nodes of
//! sixteen children and traverses these: 2.2 to 3.4 times the rays of obvhs' eight-wide nodes with
//! an exact triangle test. A binary build of this crate gave at most 2 % more rays than obvhs' and
//! was dropped; `crates/tracer/BENCHMARKS.md` has the numbers.
//!
//! Crossings of triangles are decided in 64 bits, exactly if in doubt, so no ray leaks between
//! neighbours, and no hit depends on the tree or the processor.

mod aabb;
mod ball;
mod binary_tree;
mod builder;
mod collapse;
mod lanes;
mod ray;
mod rigid_tree;
mod slices;
mod tree;
mod triangle;
mod world_tree;

/// Hash of the sources.
pub const SOURCE_HASH: &str = env!("SOURCE_HASH");

pub use aabb::Aabb;
pub use ball::{Approach, Ball};
pub use builder::build_tree;
pub use collapse::LeafRules;
#[cfg(target_arch = "x86_64")]
pub use lanes::Avx2;
pub use lanes::{Lanes, Portable};
pub use ray::Ray;
pub use rigid_tree::{LeafRay, RigidTree};
pub use slices::Slices;
pub use tree::{Child, Leaves, Tree};
pub use triangle::Crossing;
pub use world_tree::{Numbers, Part, WorldTree};
