//! A mesh's triangles under a tree, in object space; shared by every object that shows the mesh.

use glam::{DVec3, Vec3};

use crate::bounds::Bounds;
use crate::bvh::Tree;
use crate::lanes::{EdgeRay, LEAF, Lanes, Triangles};
use crate::ray::Ray;
use crate::scene::Mesh;
use crate::triangle::{Crossing, cross};

/// Room for rounding when a ray is moved up to the sphere around the mesh.
const SPHERE_SLACK: f64 = 1.0 + 1e-6;
/// Rounding of a weight, as a part of the squared greatest length times the direction's: a few dozen operations err by
/// 1.1e-16 of at most that, and lengths are bounded by twice the reach.
const ROUNDING: f64 = 1e-14;

/// Triangles under a tree, those of a leaf side by side.
pub(crate) struct MeshTree {
    tree: Tree,
    leaves: Vec<Leaf>,
    centre: DVec3,
    radius: f64,
    /// The greatest coordinate of the mesh and of approached origins, metres.
    reach: f64,
}

/// Triangles that are tested together, by the tree's number of the leaf.
#[repr(C, align(32))]
struct Leaf {
    triangles: Triangles,
    /// Their indices in the mesh; unused lanes repeat the first.
    indices: [u32; LEAF],
    /// One bit per used lane.
    used: u32,
}

/// A ray moved up to the mesh, so that its origin is of the mesh's own magnitude.
struct Approach {
    ray: Ray,
    /// What was taken off `t`, in units of the direction.
    start: f64,
    /// Object-space length of the direction.
    length: f64,
}

impl MeshTree {
    pub fn of(mesh: &Mesh) -> Self {
        let boxes: Vec<Bounds> = (0..mesh.triangles.len())
            .map(|triangle| Bounds::around(corners(mesh, triangle).map(|corner| corner.as_dvec3())))
            .collect();
        let bounds = boxes
            .iter()
            .fold(Bounds::EMPTY, |union, bounds| union.union(*bounds));
        let radius = 0.5 * bounds.diagonal() * SPHERE_SLACK;
        let reach = bounds.centre().abs().max_element() + radius;
        let tree = Tree::over(&boxes, reach, LEAF as u32);
        let leaves = (0..tree.leaves())
            .map(|leaf| Leaf::of(mesh, tree.items(leaf)))
            .collect();
        Self {
            tree,
            leaves,
            centre: bounds.centre(),
            radius,
            reach,
        }
    }

    /// Bytes that tree and triangles take.
    pub fn bytes(&self) -> usize {
        self.tree.bytes() + size_of_val(self.leaves.as_slice())
    }

    /// Visits the crossings at `0 < t <= limit`, those of equal `t` in any order. `visit` takes the triangle's index in
    /// the mesh and returns the limit from then on: one below 0 ends the walk.
    #[inline(always)]
    pub fn walk<L: Lanes>(
        &self,
        lanes: L,
        ray: &Ray,
        limit: f64,
        mut visit: impl FnMut(u32, Crossing) -> f64,
    ) {
        let Some(approach) = self.approach(ray) else {
            return;
        };
        let edges = self.edge_ray(&approach);
        let mut limit = limit;
        self.tree.walk(
            lanes,
            &approach.unit(),
            approach.local(limit),
            #[inline(always)]
            |leaf| {
                let leaf = &self.leaves[leaf as usize];
                let mut inside = lanes.cross(&leaf.triangles, &edges) & leaf.used;
                while inside != 0 {
                    let lane = inside.trailing_zeros() as usize;
                    inside &= inside - 1;
                    if let Some(crossing) = leaf.crossing(&approach, lane, limit) {
                        limit = visit(leaf.indices[lane], crossing);
                    }
                }
                approach.local(limit)
            },
        );
    }

    /// Every crossing at `0 < t`, tree or no tree: what the walks are tested against.
    pub fn exhaustive(&self, ray: &Ray, mut visit: impl FnMut(u32, Crossing)) {
        let Some(approach) = self.approach(ray) else {
            return;
        };
        for leaf in &self.leaves {
            for lane in (0..LEAF).filter(|lane| leaf.used >> lane & 1 == 1) {
                if let Some(crossing) = leaf.crossing(&approach, lane, f64::INFINITY) {
                    visit(leaf.indices[lane], crossing);
                }
            }
        }
    }

    #[inline(always)]
    fn edge_ray(&self, approach: &Approach) -> EdgeRay {
        let Ray { origin, direction } = approach.ray;
        let longest = 2.0 * origin.abs().max_element().max(self.reach);
        let doubt = ROUNDING * longest * longest * direction.abs().max_element();
        EdgeRay::new(origin, direction, doubt)
    }

    /// None where the ray misses the sphere around the mesh.
    #[inline(always)]
    fn approach(&self, ray: &Ray) -> Option<Approach> {
        let squared = ray.direction.length_squared();
        let nearest = (self.centre - ray.origin).dot(ray.direction) / squared;
        let miss = ray.at(nearest).distance_squared(self.centre);
        let length = squared.sqrt();
        // A flat mesh may fill its sphere's equator only: the sphere is grown, never shrunk, by rounding.
        if miss > self.radius * self.radius * SPHERE_SLACK {
            return None;
        }
        let start = (nearest - self.radius / length).max(0.0);
        Some(Approach {
            ray: Ray {
                origin: ray.at(start),
                direction: ray.direction,
            },
            start,
            length,
        })
    }
}

impl Approach {
    /// The ray with a unit direction, as the tree's slab test wants it.
    #[inline]
    fn unit(&self) -> Ray {
        Ray {
            origin: self.ray.origin,
            direction: self.ray.direction / self.length,
        }
    }

    /// A limit on `t` as a distance from the approached origin.
    #[inline]
    fn local(&self, limit: f64) -> f64 {
        (limit - self.start) * self.length
    }
}

impl Leaf {
    /// Of at most four triangles of the mesh.
    fn of(mesh: &Mesh, items: &[u32]) -> Self {
        let indices = std::array::from_fn(|lane| *items.get(lane).unwrap_or(&items[0]));
        let corners = indices.map(|triangle| corners(mesh, triangle as usize));
        Self {
            triangles: Triangles(std::array::from_fn(|vertex| {
                std::array::from_fn(|axis| corners.map(|corners| corners[vertex].to_array()[axis]))
            })),
            indices,
            used: (1 << items.len()) - 1,
        }
    }

    #[inline]
    fn crossing(&self, approach: &Approach, lane: usize, limit: f64) -> Option<Crossing> {
        let corners = (self.triangles.0)
            .map(|vertex| DVec3::from_array(vertex.map(|axis| f64::from(axis[lane]))));
        let mut crossing = cross(&approach.ray, corners)?;
        crossing.t += approach.start;
        (crossing.t > 0.0 && crossing.t <= limit).then_some(crossing)
    }
}

fn corners(mesh: &Mesh, triangle: usize) -> [Vec3; 3] {
    mesh.triangles[triangle].map(|index| mesh.positions[index as usize])
}
