//! Slices of the shutter interval, and the boxes that objects sweep within each.

use crate::geometry::aabb::Aabb;
use crate::motion::extent::Extent;
use crate::motion::sweep::{greatest_speed, swept_aabb};
use crate::scene::Scene;

/// Part of its diagonal that an object travels within a slice at most, unless that takes too many slices.
const TRAVEL_PER_SLICE: f64 = 0.25;
const MOST_SLICES: usize = 16;

/// Cuts `[from, to]` into equally long slices; returns per slice the boxes that the objects sweep.
pub(crate) fn sweep_slices(scene: &Scene, from: f64, to: f64) -> Vec<Vec<Aabb>> {
    let extents = Extent::of_meshes(scene);
    let count = slice_count(scene, &extents, from, to);
    let border = |slice: usize| from + (to - from) * slice as f64 / count as f64;
    (0..count)
        .map(|slice| {
            let [from, to] = [slice, slice + 1].map(border);
            (0..scene.objects.len())
                .map(|object| swept_aabb(scene, &extents, object, from, to))
                .collect()
        })
        .collect()
}

/// The smallest power of two with which no object travels too far within a slice.
fn slice_count(scene: &Scene, extents: &[Extent], from: f64, to: f64) -> usize {
    let needed = (0..scene.objects.len())
        .map(|object| {
            let diagonal = swept_aabb(scene, extents, object, from, from).diagonal();
            let travel = greatest_speed(scene, extents, object, from, to) * (to - from);
            travel / (TRAVEL_PER_SLICE * diagonal).max(f64::MIN_POSITIVE)
        })
        .fold(1.0, f64::max);
    (needed.min(MOST_SLICES as f64).ceil() as usize).next_power_of_two()
}
