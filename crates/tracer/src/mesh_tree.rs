//! A mesh's triangles under a tree, in object space; shared by every object that shows the mesh.

use glam::{DVec3, Vec3};

use crate::bounds::Bounds;
use crate::bvh::Tree;
use crate::ray::Ray;
use crate::scene::Mesh;
use crate::triangle::{Crossing, cross};

const TRIANGLES_PER_LEAF: u32 = 4;
/// Room for rounding when a ray is moved up to the sphere around the mesh.
const SPHERE_SLACK: f64 = 1.0 + 1e-6;

/// Triangles in the order of the tree's slots.
pub(crate) struct MeshTree {
    tree: Tree,
    triangles: Vec<[Vec3; 3]>,
    centre: DVec3,
    radius: f64,
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
        let corners: Vec<[Vec3; 3]> = mesh
            .triangles
            .iter()
            .map(|triangle| triangle.map(|index| mesh.positions[index as usize]))
            .collect();
        let boxes: Vec<Bounds> = corners
            .iter()
            .map(|corners| Bounds::around(corners.map(|corner| corner.as_dvec3())))
            .collect();
        let bounds = boxes
            .iter()
            .fold(Bounds::EMPTY, |union, bounds| union.union(*bounds));
        let radius = 0.5 * bounds.diagonal() * SPHERE_SLACK;
        let reach = bounds.centre().abs().max_element() + radius;
        let tree = Tree::over(&boxes, reach, TRIANGLES_PER_LEAF);
        let triangles = tree
            .order()
            .iter()
            .map(|&triangle| corners[triangle as usize])
            .collect();
        Self {
            tree,
            triangles,
            centre: bounds.centre(),
            radius,
        }
    }

    /// Visits the crossings at `0 < t <= limit` that the tree finds. `visit` takes the triangle's index in the mesh
    /// and returns the limit from then on.
    #[inline]
    pub fn walk(&self, ray: &Ray, limit: f64, mut visit: impl FnMut(u32, Crossing) -> f64) {
        let Some(approach) = self.approach(ray) else {
            return;
        };
        let mut limit = limit;
        self.tree
            .walk(&approach.unit(), approach.local(limit), |slot| {
                if let Some(crossing) = self.crossing(&approach, slot, limit) {
                    limit = visit(self.tree.order()[slot], crossing);
                }
                approach.local(limit)
            });
    }

    /// Whether a crossing at `0 < t <= limit` satisfies `blocks`.
    #[inline]
    pub fn any(
        &self,
        ray: &Ray,
        limit: f64,
        mut blocks: impl FnMut(u32, Crossing) -> bool,
    ) -> bool {
        let Some(approach) = self.approach(ray) else {
            return false;
        };
        self.tree
            .any(&approach.unit(), approach.local(limit), |slot| {
                self.crossing(&approach, slot, limit)
                    .is_some_and(|crossing| blocks(self.tree.order()[slot], crossing))
            })
    }

    /// Every crossing at `0 < t`, tree or no tree: what the walks are tested against.
    pub fn exhaustive(&self, ray: &Ray, mut visit: impl FnMut(u32, Crossing)) {
        let Some(approach) = self.approach(ray) else {
            return;
        };
        for slot in 0..self.triangles.len() {
            if let Some(crossing) = self.crossing(&approach, slot, f64::INFINITY) {
                visit(self.tree.order()[slot], crossing);
            }
        }
    }

    #[inline]
    fn crossing(&self, approach: &Approach, slot: usize, limit: f64) -> Option<Crossing> {
        let corners = self.triangles[slot].map(|corner| corner.as_dvec3());
        let mut crossing = cross(&approach.ray, corners)?;
        crossing.t += approach.start;
        (crossing.t > 0.0 && crossing.t <= limit).then_some(crossing)
    }

    /// None where the ray misses the sphere around the mesh.
    #[inline]
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
