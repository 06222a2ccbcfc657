//! What rays meet in an object's space: a rigid mesh or a deforming one.

use crate::accel::deforming_tree::ShapeTree;
use crate::accel::lanes::Lanes;
use crate::accel::rigid_tree::MeshTree;
use crate::geometry::ray::Ray;
use crate::geometry::triangle::Crossing;
use crate::scene::Mesh;

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

    /// The leaves of a rigid mesh, which may lie in the tree of the world.
    #[inline(always)]
    pub fn rigid(&self) -> &MeshTree {
        match self {
            Geometry::Rigid(tree) => tree,
            Geometry::Deforming(_) => panic!("only rigid meshes lie in the tree of the world"),
        }
    }

    /// Bytes that trees and triangles take.
    pub fn bytes(&self) -> usize {
        match self {
            Geometry::Rigid(tree) => tree.bytes(),
            Geometry::Deforming(tree) => tree.bytes(),
        }
    }

    /// Room that [`Geometry::walk`] needs for children that wait.
    pub fn most_waiting(&self) -> usize {
        match self {
            Geometry::Rigid(tree) => tree.most_waiting(),
            Geometry::Deforming(tree) => tree.most_waiting(),
        }
    }

    /// As [`MeshTree::walk`], at a time.
    #[inline(always)]
    pub fn walk<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        waiting: &mut [u64],
        ray: &Ray,
        time: f64,
        limit: f64,
        visit: impl FnMut(u32, Crossing) -> f64,
    ) {
        match self {
            Geometry::Rigid(tree) => tree.walk::<L, SORTED>(lanes, waiting, ray, limit, visit),
            Geometry::Deforming(tree) => {
                tree.walk::<L, SORTED>(lanes, waiting, ray, time, limit, visit)
            }
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
