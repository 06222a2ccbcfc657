//! The triangles of a deforming mesh under trees, one per slice of time.

use crate::accel::bvh::{Child, Leaves, Tree};
use crate::accel::collapse::LeafRules;
use crate::accel::lanes::Lanes;
use crate::geometry::aabb::Bounds;
use crate::geometry::ball::{Approach, Ball};
use crate::geometry::ray::Ray;
use crate::geometry::triangle::{Crossing, cross};
use crate::scene::Mesh;

const MOST_SLICES: usize = 16;
/// Triangles are tested one by one, each as long as a visit takes.
const LEAF_RULES: LeafRules = LeafRules {
    most: 4,
    item_cost: 1.0,
};

/// A deforming mesh between two times. Vertices are interpolated to the ray's time in `f64`, the same for every triangle
/// that has them, so that no gap opens between neighbours.
pub(crate) struct ShapeTree<'a> {
    mesh: &'a Mesh,
    from: f64,
    to: f64,
    slices: Vec<Slice>,
}

/// Trees over the boxes that triangles sweep within a slice, and a sphere around them.
struct Slice {
    tree: Tree,
    leaves: Leaves,
    ball: Ball,
}

impl<'a> ShapeTree<'a> {
    /// Of a mesh that rays meet at times in `[from, to]`.
    pub fn of(mesh: &'a Mesh, from: f64, to: f64) -> Self {
        let count = slice_count(mesh, from, to);
        let border = |slice: usize| from + (to - from) * slice as f64 / count as f64;
        let slices = (0..count)
            .map(|slice| Slice::of(mesh, border(slice), border(slice + 1)))
            .collect();
        Self {
            mesh,
            from,
            to,
            slices,
        }
    }

    /// Bytes that the trees take.
    pub fn bytes(&self) -> usize {
        let slices = self.slices.iter();
        slices
            .map(|slice| slice.tree.bytes() + slice.leaves.bytes())
            .sum()
    }

    /// Room that [`ShapeTree::walk`] needs for children that wait.
    pub fn most_waiting(&self) -> usize {
        let slices = self.slices.iter();
        slices
            .map(|slice| slice.tree.most_waiting)
            .max()
            .unwrap_or(0)
    }

    /// As [`crate::accel::rigid_tree::MeshTree::walk`], at a time.
    #[inline(always)]
    pub fn walk<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        waiting: &mut [u64],
        ray: &Ray,
        time: f64,
        limit: f64,
        mut visit: impl FnMut(u32, Crossing) -> f64,
    ) {
        let slice = self.slice(time);
        let Some(approach) = slice.ball.approach(ray) else {
            return;
        };
        let mut limit = limit;
        slice.tree.walk::<L, SORTED>(
            lanes,
            waiting,
            (&approach.ray, Child::ROOT),
            approach.local(limit),
            #[inline(always)]
            |_, leaf| {
                for &triangle in slice.leaves.items(leaf) {
                    if let Some(crossing) = self.crossing(&approach, time, triangle, limit) {
                        limit = visit(triangle, crossing);
                    }
                }
                approach.local(limit)
            },
            |_| {},
        );
    }

    /// Every crossing at `0 < t`, tree or no tree: what the walks are tested against.
    pub fn exhaustive(&self, ray: &Ray, time: f64, mut visit: impl FnMut(u32, Crossing)) {
        let Some(approach) = self.slice(time).ball.approach(ray) else {
            return;
        };
        for triangle in 0..self.mesh.triangles.len() as u32 {
            if let Some(crossing) = self.crossing(&approach, time, triangle, f64::INFINITY) {
                visit(triangle, crossing);
            }
        }
    }

    fn crossing(
        &self,
        approach: &Approach,
        time: f64,
        triangle: u32,
        limit: f64,
    ) -> Option<Crossing> {
        let mut crossing = cross(&approach.ray, self.mesh.at(time).corners(triangle))?;
        crossing.t += approach.start;
        (crossing.t > 0.0 && crossing.t <= limit).then_some(crossing)
    }

    fn slice(&self, time: f64) -> &Slice {
        let fraction = (time - self.from) / (self.to - self.from).max(f64::MIN_POSITIVE);
        let slice = (fraction * self.slices.len() as f64) as usize;
        &self.slices[slice.min(self.slices.len() - 1)]
    }
}

impl Slice {
    /// Vertices move in straight lines between key shapes: the box around a triangle at both ends and at the keys inside
    /// contains it at all times.
    fn of(mesh: &Mesh, from: f64, to: f64) -> Self {
        let inside = mesh.shape_times().filter(|time| from < *time && *time < to);
        let times: Vec<f64> = inside.chain([from, to]).collect();
        let boxes: Vec<Bounds> = (0..mesh.triangles.len() as u32)
            .map(|triangle| {
                Bounds::around(
                    times
                        .iter()
                        .flat_map(|time| mesh.at(*time).corners(triangle)),
                )
            })
            .collect();
        let bounds = boxes
            .iter()
            .fold(Bounds::EMPTY, |union, bounds| union.union(*bounds));
        let (tree, leaves) = Tree::over(&boxes, LEAF_RULES);
        Self {
            tree,
            leaves,
            ball: Ball::around(bounds.centre(), [bounds.min, bounds.max]),
        }
    }
}

/// The smallest power of two that keeps every vertex's way within a slice below the mean edge, so that boxes do not
/// swell; few enough not to cost more memory than they save time.
fn slice_count(mesh: &Mesh, from: f64, to: f64) -> usize {
    let shape = mesh.at(0.5 * (from + to));
    let edges: f64 = (0..mesh.triangles.len() as u32)
        .map(|triangle| {
            let [a, b, c] = shape.corners(triangle);
            a.distance(b) + b.distance(c) + c.distance(a)
        })
        .sum();
    let mean_edge = edges / (3 * mesh.triangles.len()) as f64;
    let mut times: Vec<f64> = (mesh.shape_times())
        .filter(|time| from < *time && *time < to)
        .chain([from, to])
        .collect();
    times.sort_by(f64::total_cmp);
    let way: f64 = times
        .windows(2)
        .map(|span| mesh.vertex_reach(span[0], span[1])[1] * (span[1] - span[0]))
        .sum();
    let needed = (way / mean_edge.max(f64::MIN_POSITIVE)).clamp(1.0, MOST_SLICES as f64);
    (needed.ceil() as usize).next_power_of_two()
}
