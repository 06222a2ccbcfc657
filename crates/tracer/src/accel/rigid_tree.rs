//! A mesh's triangles under a tree, in object space; shared by every object that shows the mesh.

use bytemuck::{Pod, Zeroable};
use glam::{DAffine3, DVec3, Vec3};
use prefetch_index::prefetch_index;

use crate::accel::bvh::{Child, Tree};
use crate::accel::collapse::LeafRules;
use crate::accel::lanes::{EdgeRay, LEAF, Lanes, Triangles};
use crate::accel::pages::Pages;
use crate::geometry::aabb::Bounds;
use crate::geometry::ball::{Approach, Ball};
use crate::geometry::ray::Ray;
use crate::geometry::triangle::{Crossing, cross};
use crate::scene::Mesh;

/// Triangles in leaves, those of a leaf side by side, and a tree over the leaves.
pub(crate) struct MeshTree {
    /// None where no walk needs it: where every object that shows the mesh has its leaves in the tree of the world.
    tree: Option<Tree>,
    leaves: Pages<Leaf>,
    ball: Ball,
    /// The greatest coordinate of the mesh, metres.
    reach: f64,
}

/// A ray made ready for the leaves of a mesh, in the mesh's space.
pub(crate) struct Aim {
    approach: Approach,
    edges: EdgeRay,
}

/// Triangles that are tested together, by the tree's number of the leaf.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C, align(32))]
struct Leaf {
    triangles: Triangles,
    /// Their indices in the mesh; unused lanes repeat the first.
    indices: [u32; LEAF],
    /// One bit per used lane.
    used: u32,
    /// The greatest extent of any of them along an axis, metres.
    size: f32,
    /// Room up to the next one's beginning.
    unused: [u32; 6],
}

impl MeshTree {
    pub fn of(mesh: &Mesh) -> Self {
        let boxes: Vec<Bounds> = (0..mesh.triangles.len())
            .map(|triangle| Bounds::around(corners(mesh, triangle).map(|corner| corner.as_dvec3())))
            .collect();
        let bounds = boxes
            .iter()
            .fold(Bounds::EMPTY, |union, bounds| union.union(*bounds));
        let vertices = mesh.triangles.iter().flatten();
        let vertices = vertices.map(|&vertex| mesh.positions[vertex as usize].as_dvec3());
        // Eight triangles are tested at once, as fast as one.
        let rules = LeafRules {
            most: LEAF as u32,
            item_cost: 0.0,
        };
        let (tree, listed) = Tree::over(&boxes, rules);
        let leaves = (0..listed.count())
            .map(|leaf| Leaf::of(mesh, listed.items(leaf)))
            .collect();
        Self {
            tree: Some(tree),
            leaves: Pages::of(leaves),
            ball: Ball::around(bounds.centre(), vertices),
            reach: bounds.reach(),
        }
    }

    /// Leaves the tree over the leaves out: only [`MeshTree::meet`] remains.
    pub fn drop_tree(&mut self) {
        self.tree = None;
    }

    /// Bytes that tree and triangles take.
    pub fn bytes(&self) -> usize {
        self.tree.as_ref().map_or(0, Tree::bytes) + size_of_val::<[Leaf]>(&self.leaves)
    }

    /// Room that [`MeshTree::walk`] needs for children that wait.
    pub fn most_waiting(&self) -> usize {
        self.tree.as_ref().map_or(0, |tree| tree.most_waiting)
    }

    /// How many leaves there are.
    pub fn leaf_count(&self) -> usize {
        self.leaves.len()
    }

    /// Boxes around the leaves, at a pose.
    pub fn leaf_bounds(&self, pose: &DAffine3) -> Vec<Bounds> {
        let posed = |corner| pose.transform_point3(corner);
        let leaves = self.leaves.iter();
        leaves
            .map(|leaf| {
                let corners = leaf.lanes().flat_map(|lane| leaf.corners(lane));
                Bounds::around(corners.map(posed))
            })
            .collect()
    }

    /// None where the ray misses the mesh.
    #[inline(always)]
    pub fn aim(&self, ray: &Ray) -> Option<Aim> {
        let approach = self.ball.approach(ray)?;
        let edges = EdgeRay::new(approach.ray.origin, approach.ray.direction, self.reach);
        Some(Aim { approach, edges })
    }

    /// Visits the crossings at `0 < t <= limit`: roughly from near to far where `SORTED`, else in any order. `visit` takes
    /// the triangle's index in the mesh and returns the limit from then on: one below 0 ends the walk.
    #[inline(always)]
    pub fn walk<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        waiting: &mut [u64],
        ray: &Ray,
        limit: f64,
        mut visit: impl FnMut(u32, Crossing) -> f64,
    ) {
        let Some(aim) = self.aim(ray) else {
            return;
        };
        let tree = self
            .tree
            .as_ref()
            .expect("only meshes with trees are walked through");
        let mut limit = limit;
        tree.walk::<L, SORTED>(
            lanes,
            waiting,
            (&aim.approach.ray, Child::ROOT),
            aim.approach.local(limit),
            #[inline(always)]
            |_, leaf| {
                limit = self.meet(lanes, leaf, &aim, limit, &mut visit);
                aim.approach.local(limit)
            },
            #[inline(always)]
            |leaf| self.fetch(leaf),
        );
    }

    /// Visits the crossings of one leaf, as [`MeshTree::walk`] does; returns the limit from then on.
    #[inline(always)]
    pub fn meet<L: Lanes>(
        &self,
        lanes: L,
        leaf: u32,
        aim: &Aim,
        mut limit: f64,
        mut visit: impl FnMut(u32, Crossing) -> f64,
    ) -> f64 {
        let leaf = &self.leaves[leaf as usize];
        let mut inside = lanes.cross(&leaf.triangles, leaf.size, &aim.edges) & leaf.used;
        while inside != 0 {
            let lane = inside.trailing_zeros() as usize;
            inside &= inside - 1;
            if let Some(crossing) = leaf.crossing(&aim.approach, lane, limit) {
                limit = visit(leaf.indices[lane], crossing);
            }
        }
        limit
    }

    /// Has the processor fetch a leaf from memory, to be there when it is met.
    #[inline(always)]
    pub fn fetch(&self, leaf: u32) {
        self.leaves[leaf as usize].fetch();
    }

    /// Every crossing at `0 < t`, tree or no tree: what the walks are tested against.
    pub fn exhaustive(&self, ray: &Ray, mut visit: impl FnMut(u32, Crossing)) {
        let Some(approach) = self.ball.approach(ray) else {
            return;
        };
        for leaf in self.leaves.iter() {
            for lane in leaf.lanes() {
                if let Some(crossing) = leaf.crossing(&approach, lane, f64::INFINITY) {
                    visit(leaf.indices[lane], crossing);
                }
            }
        }
    }
}

impl Leaf {
    /// Of at most eight triangles of the mesh.
    fn of(mesh: &Mesh, items: &[u32]) -> Self {
        let indices = std::array::from_fn(|lane| *items.get(lane).unwrap_or(&items[0]));
        let corners = indices.map(|triangle| corners(mesh, triangle as usize));
        Self {
            triangles: Triangles(std::array::from_fn(|vertex| {
                std::array::from_fn(|axis| corners.map(|corners| corners[vertex].to_array()[axis]))
            })),
            indices,
            used: (1 << items.len()) - 1,
            size: corners.map(extent).into_iter().fold(0.0, f32::max),
            unused: [0; 6],
        }
    }

    /// The used lanes.
    fn lanes(&self) -> impl Iterator<Item = usize> {
        (0..LEAF).filter(|lane| self.used >> lane & 1 == 1)
    }

    #[inline(always)]
    fn fetch(&self) {
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

    #[inline(always)]
    fn crossing(&self, approach: &Approach, lane: usize, limit: f64) -> Option<Crossing> {
        let mut crossing = cross(&approach.ray, self.corners(lane))?;
        crossing.t += approach.start;
        (crossing.t > 0.0 && crossing.t <= limit).then_some(crossing)
    }
}

fn corners(mesh: &Mesh, triangle: usize) -> [Vec3; 3] {
    mesh.triangles[triangle].map(|index| mesh.positions[index as usize])
}

/// The greatest extent along an axis, metres; never too small.
fn extent([a, b, c]: [Vec3; 3]) -> f32 {
    let sides = a.max(b).max(c) - a.min(b).min(c);
    sides.max_element().next_up()
}
