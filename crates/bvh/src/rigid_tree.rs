//! The tree of a rigid mesh, in object space.

use glam::{DAffine3, DVec3, Vec3};
use prefetch_index::prefetch_index;

use crate::aabb::Aabb;
use crate::ball::{Approach, Ball};
use crate::builder::build_tree;
use crate::collapse::LeafRules;
use crate::lanes::{EdgeRay, LEAF, Lanes, Triangles};
use crate::ray::Ray;
use crate::tree::{Child, Tree};
use crate::triangle::Crossing;

/// Leaves of triangles side by side, and a tree over the leaves.
pub struct RigidTree {
    /// Tree over the leaves.
    tree: Tree,
    leaves: Vec<Leaf>,
    /// A ball around the mesh.
    pub ball: Ball,
    /// Greatest coordinate of the mesh, metres.
    largest_coordinate: f64,
}

/// A ray in the mesh's space, prepared for its leaves.
pub struct LeafRay {
    approach: Approach,
    edges: EdgeRay,
}

/// The triangles of a mesh, and its vertices in metres.
struct Mesh<'a> {
    positions: &'a [Vec3],
    triangles: &'a [[u32; 3]],
}

/// Triangles that are tested together.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
struct Leaf {
    triangles: Triangles,
    /// Their indices in the mesh; unused lanes repeat the first.
    indices: [u32; LEAF],
    /// One bit per used lane.
    used: u32,
    /// Greatest extent of any of them along an axis, metres.
    size: f32,
}

impl RigidTree {
    /// Builds the tree of the triangles of a mesh; `positions` are its vertices, in metres.
    pub fn build(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let mesh = Mesh {
            positions,
            triangles,
        };
        let boxes: Vec<Aabb> = (0..triangles.len() as u32)
            .map(|triangle| Aabb::around(mesh.corners(triangle).map(|corner| corner.as_dvec3())))
            .collect();
        let union = (boxes.iter()).fold(Aabb::EMPTY, |union, aabb| union.union(*aabb));
        let vertices = triangles.iter().flatten();
        let vertices = vertices.map(|&vertex| positions[vertex as usize].as_dvec3());
        // Eight triangles are tested at once, as fast as one.
        let rules = LeafRules {
            max_items: LEAF as u32,
            item_cost: 0.0,
        };
        let (tree, listed) = build_tree(&boxes, rules);
        let leaves = (0..listed.count())
            .map(|leaf| Leaf::new(&mesh, listed.items(leaf)))
            .collect();
        Self {
            tree,
            leaves,
            ball: Ball::around(union.centre(), vertices),
            largest_coordinate: union.largest_coordinate(),
        }
    }

    /// Size of the stack that [`RigidTree::traverse`] needs.
    #[inline]
    pub fn stack_size(&self) -> usize {
        self.tree.stack_size
    }

    /// Number of leaves.
    pub fn leaf_count(&self) -> usize {
        self.leaves.len()
    }

    /// Boxes around the leaves, transformed by `pose`.
    pub fn leaf_aabbs(&self, pose: &DAffine3) -> Vec<Aabb> {
        let to_world = |corner| pose.transform_point3(corner);
        let leaves = self.leaves.iter();
        leaves
            .map(|leaf| {
                let corners = leaf.lanes().flat_map(|lane| leaf.corners(lane));
                Aabb::around(corners.map(to_world))
            })
            .collect()
    }

    /// Prepares a ray for the leaves; none if it misses the mesh.
    #[inline(always)]
    pub fn prepare_ray(&self, ray: &Ray) -> Option<LeafRay> {
        let approach = self.ball.approach(ray)?;
        let ray = &approach.ray;
        let edges = EdgeRay::new(ray.origin, ray.direction, self.largest_coordinate);
        Some(LeafRay { approach, edges })
    }

    /// Visits the crossings at `0 < t <= limit`: roughly from near to far if `SORTED`, else in any
    /// order. `visit` takes the triangle's index in the mesh and returns the new limit; one below 0
    /// ends the traversal.
    #[inline(always)]
    pub fn traverse<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        stack: &mut [u64],
        ray: &Ray,
        limit: f64,
        mut visit: impl FnMut(u32, Crossing) -> f64,
    ) {
        let Some(ray) = self.prepare_ray(ray) else {
            return;
        };
        let mut limit = limit;
        self.tree.traverse::<L, SORTED>(
            lanes,
            stack,
            (&ray.approach.ray, Child::ROOT),
            ray.approach.local_limit(limit),
            #[inline(always)]
            |_, leaf| {
                limit = self.intersect_leaf(lanes, leaf, &ray, limit, &mut visit);
                ray.approach.local_limit(limit)
            },
            #[inline(always)]
            |leaf| self.prefetch(leaf),
        );
    }

    /// Visits the crossings of one leaf, as [`RigidTree::traverse`] does; returns the new limit.
    #[inline(always)]
    pub fn intersect_leaf<L: Lanes>(
        &self,
        lanes: L,
        leaf: u32,
        ray: &LeafRay,
        mut limit: f64,
        mut visit: impl FnMut(u32, Crossing) -> f64,
    ) -> f64 {
        let leaf = &self.leaves[leaf as usize];
        let mut inside = lanes.cross(&leaf.triangles, leaf.size, &ray.edges) & leaf.used;
        while inside != 0 {
            let lane = inside.trailing_zeros() as usize;
            inside &= inside - 1;
            if let Some(crossing) = ray.approach.cross(leaf.corners(lane), limit) {
                limit = visit(leaf.indices[lane], crossing);
            }
        }
        limit
    }

    /// Prefetches a leaf from memory.
    #[inline(always)]
    pub fn prefetch(&self, leaf: u32) {
        self.leaves[leaf as usize].prefetch();
    }
}

impl Leaf {
    /// Packs at most eight triangles of the mesh.
    fn new(mesh: &Mesh, items: &[u32]) -> Self {
        let indices = std::array::from_fn(|lane| *items.get(lane).unwrap_or(&items[0]));
        let corners = indices.map(|triangle| mesh.corners(triangle));
        Self {
            triangles: Triangles(std::array::from_fn(|vertex| {
                std::array::from_fn(|axis| corners.map(|corners| corners[vertex].to_array()[axis]))
            })),
            indices,
            used: (1 << items.len()) - 1,
            size: corners.map(size).into_iter().fold(0.0, f32::max),
        }
    }

    /// The used lanes.
    fn lanes(&self) -> impl Iterator<Item = usize> {
        (0..LEAF).filter(|lane| self.used >> lane & 1 == 1)
    }

    #[inline(always)]
    fn prefetch(&self) {
        let [a, b, c] = &self.triangles.0;
        for lanes in [&a[0], &a[2], &b[1], &c[0], &c[2]] {
            prefetch_index(lanes, 0);
        }
        prefetch_index(self.indices.as_slice(), 0);
    }

    #[inline(always)]
    fn corners(&self, lane: usize) -> [DVec3; 3] {
        [0, 1, 2].map(|vertex| {
            let coordinate = |axis: usize| f64::from(self.triangles.0[vertex][axis][lane]);
            DVec3::new(coordinate(0), coordinate(1), coordinate(2))
        })
    }
}

impl Mesh<'_> {
    fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].map(|vertex| self.positions[vertex as usize])
    }
}

/// The greatest extent of a triangle along an axis, metres; never too small.
fn size([a, b, c]: [Vec3; 3]) -> f32 {
    let sides = a.max(b).max(c) - a.min(b).min(c);
    sides.max_element().next_up()
}
