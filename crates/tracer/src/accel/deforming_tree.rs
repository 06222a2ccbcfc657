//! The tree of a deforming mesh, in object space.

use bvh::{Aabb, Ball, Child, Crossing, Lanes, LeafRules, Leaves, Ray, Slices, Tree, build_tree};
use scene::{Mesh, times_within};

/// Triangles are tested one by one, each in the time of a visit.
const LEAF_RULES: LeafRules = LeafRules {
    max_items: 4,
    item_cost: 1.0,
};

/// A deforming mesh between two times, with one tree per slice of time.
///
/// Vertices are interpolated to the ray's time in `f64`, the same for every triangle that has them,
/// so that no gap opens between neighbours.
pub(crate) struct DeformingTree<'a> {
    mesh: &'a Mesh,
    slices: Slices,
    /// Tree of each slice.
    trees: Vec<Slice>,
}

/// A tree over the boxes that triangles sweep within a slice, and a ball around them.
struct Slice {
    tree: Tree,
    leaves: Leaves,
    ball: Ball,
}

impl<'a> DeformingTree<'a> {
    /// Builds the trees of a mesh for rays at times in `[from, to]`.
    pub fn build(mesh: &'a Mesh, from: f64, to: f64) -> Self {
        let slices = Slices::new([from, to], needed_slices(mesh, from, to));
        Self {
            mesh,
            slices,
            trees: (slices.spans())
                .map(|[from, to]| Slice::build(mesh, from, to))
                .collect(),
        }
    }

    /// Size of the stack that [`DeformingTree::traverse`] needs.
    pub fn stack_size(&self) -> usize {
        let sizes = self.trees.iter().map(|slice| slice.tree.stack_size);
        sizes.max().unwrap_or(0)
    }

    /// Traverses the mesh at a time; see [`bvh::RigidTree::traverse`].
    #[inline(always)]
    pub fn traverse<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        stack: &mut [u64],
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
        slice.tree.traverse::<L, SORTED>(
            lanes,
            stack,
            (&approach.ray, Child::ROOT),
            approach.local_limit(limit),
            #[inline(always)]
            |_, leaf| {
                for &triangle in slice.leaves.items(leaf) {
                    let corners = self.mesh.at(time).corners(triangle);
                    if let Some(crossing) = approach.cross(corners, limit) {
                        limit = visit(triangle, crossing);
                    }
                }
                approach.local_limit(limit)
            },
            |_| {},
        );
    }

    /// The ball around the mesh at a time.
    pub fn ball(&self, time: f64) -> &Ball {
        &self.slice(time).ball
    }

    fn slice(&self, time: f64) -> &Slice {
        &self.trees[self.slices.find(time)]
    }
}

impl Slice {
    /// Builds the tree of a slice. Vertices move in straight lines between key shapes, so the box
    /// around a triangle at both ends and at the keys inside contains it at all times.
    fn build(mesh: &Mesh, from: f64, to: f64) -> Self {
        let times = times_within(mesh.shape_times(), from, to);
        let boxes: Vec<Aabb> = (0..mesh.triangles.len() as u32)
            .map(|triangle| {
                let corners = times.iter().map(|time| mesh.at(*time).corners(triangle));
                Aabb::around(corners.flatten())
            })
            .collect();
        let union = (boxes.iter()).fold(Aabb::EMPTY, |union, aabb| union.union(*aabb));
        let (tree, leaves) = build_tree(&boxes, LEAF_RULES);
        Self {
            tree,
            leaves,
            ball: Ball::around(union.centre(), [union.min, union.max]),
        }
    }
}

/// The number of slices within which no vertex travels farther than the mean edge, so that boxes
/// stay small.
fn needed_slices(mesh: &Mesh, from: f64, to: f64) -> f64 {
    let shape = mesh.at(0.5 * (from + to));
    let edges: f64 = (0..mesh.triangles.len() as u32)
        .map(|triangle| {
            let [a, b, c] = shape.corners(triangle);
            a.distance(b) + b.distance(c) + c.distance(a)
        })
        .sum();
    let mean_edge = edges / (3 * mesh.triangles.len()) as f64;
    let travel: f64 = times_within(mesh.shape_times(), from, to)
        .windows(2)
        .map(|span| mesh.vertex_maxima(span[0], span[1])[1] * (span[1] - span[0]))
        .sum();
    travel / mean_edge.max(f64::MIN_POSITIVE)
}
