//! What rays meet in an object's space: a rigid mesh or a deforming one.

use crate::mesh_tree::MeshTree;
use crate::ray::Ray;
use crate::scene::Mesh;
use crate::shape_tree::ShapeTree;
use crate::triangle::Crossing;

/// A mesh under its trees; shared by every object that shows it.
pub(crate) enum Geometry<'a> {
    Rigid(MeshTree),
    Deforming(ShapeTree<'a>),
}

impl<'a> Geometry<'a> {
    /// Of a mesh that rays meet at times in `[from, to]`.
    pub fn of(mesh: &'a Mesh, from: f64, to: f64) -> Self {
        if mesh.deforms() {
            Geometry::Deforming(ShapeTree::of(mesh, from, to))
        } else {
            Geometry::Rigid(MeshTree::of(mesh))
        }
    }

    /// As [`MeshTree::walk`], at a time.
    #[inline]
    pub fn walk(&self, ray: &Ray, time: f64, limit: f64, visit: impl FnMut(u32, Crossing) -> f64) {
        match self {
            Geometry::Rigid(tree) => tree.walk(ray, limit, visit),
            Geometry::Deforming(tree) => tree.walk(ray, time, limit, visit),
        }
    }

    /// As [`MeshTree::any`], at a time.
    #[inline]
    pub fn any(
        &self,
        ray: &Ray,
        time: f64,
        limit: f64,
        blocks: impl FnMut(u32, Crossing) -> bool,
    ) -> bool {
        match self {
            Geometry::Rigid(tree) => tree.any(ray, limit, blocks),
            Geometry::Deforming(tree) => tree.any(ray, time, limit, blocks),
        }
    }

    /// As [`MeshTree::exhaustive`], at a time.
    pub fn exhaustive(&self, ray: &Ray, time: f64, visit: impl FnMut(u32, Crossing)) {
        match self {
            Geometry::Rigid(tree) => tree.exhaustive(ray, visit),
            Geometry::Deforming(tree) => tree.exhaustive(ray, time, visit),
        }
    }
}
