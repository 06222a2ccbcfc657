//! Equal slices of an interval of time, and the boxes that objects sweep within each.

use crate::geometry::aabb::Aabb;
use crate::motion::extent::Extent;
use crate::motion::sweep::{greatest_speed, swept_aabb};
use crate::scene::Scene;

/// Part of its diagonal that an object travels within a slice at most, unless that takes too many
/// slices.
const TRAVEL_PER_SLICE: f64 = 0.25;
const MAX_SLICES: usize = 16;

/// An interval of time, cut into equally long slices.
#[derive(Clone, Copy)]
pub(crate) struct Slices {
    from: f64,
    to: f64,
    count: usize,
}

impl Slices {
    /// Cuts `[from, to]` into at least `needed` slices, rounded up to a power of two, and into 16
    /// at most.
    pub fn new([from, to]: [f64; 2], needed: f64) -> Self {
        let count = needed.clamp(1.0, MAX_SLICES as f64).ceil() as usize;
        Self {
            from,
            to,
            count: count.next_power_of_two(),
        }
    }

    /// The ends of each slice.
    pub fn spans(self) -> impl Iterator<Item = [f64; 2]> {
        let border = move |slice: usize| {
            self.from + (self.to - self.from) * slice as f64 / self.count as f64
        };
        (0..self.count).map(move |slice| [slice, slice + 1].map(border))
    }

    /// The slice that contains a time.
    #[inline(always)]
    pub fn find(self, time: f64) -> usize {
        if self.count == 1 {
            return 0;
        }
        let fraction = (time - self.from) / (self.to - self.from);
        ((fraction * self.count as f64) as usize).min(self.count - 1)
    }

    /// Returns true if a time is in the interval.
    #[inline(always)]
    pub fn contains(self, time: f64) -> bool {
        self.from <= time && time <= self.to
    }
}

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
