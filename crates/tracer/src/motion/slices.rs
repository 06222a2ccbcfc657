//! The boxes that objects sweep within slices of an interval of time.

use bvh::{Aabb, Slices};
use scene::Scene;

use crate::motion::extent::Extent;
use crate::motion::sweep::{greatest_speed, swept_aabb};

/// Part of its diagonal that an object travels within a slice at most, unless that takes too many
/// slices.
const TRAVEL_PER_SLICE: f64 = 0.25;

/// Cuts `[from, to]` into slices within which no object travels far; returns them with the boxes
/// that the objects sweep in each.
pub(crate) fn sweep_slices(scene: &Scene, from: f64, to: f64) -> (Slices, Vec<Vec<Aabb>>) {
    let extents = Extent::of_meshes(scene);
    let objects = 0..scene.objects.len();
    let needed = objects.clone().map(|object| {
        let diagonal = swept_aabb(scene, &extents, object, from, from).diagonal();
        let travel = greatest_speed(scene, &extents, object, from, to) * (to - from);
        travel / (TRAVEL_PER_SLICE * diagonal).max(f64::MIN_POSITIVE)
    });
    let slices = Slices::new([from, to], needed.fold(1.0, f64::max));
    let sweep = |[from, to]: [f64; 2]| {
        let boxes = (objects.clone()).map(|object| swept_aabb(scene, &extents, object, from, to));
        boxes.collect()
    };
    (slices, slices.spans().map(sweep).collect())
}
