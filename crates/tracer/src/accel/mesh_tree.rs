//! The tree of a mesh, rigid or deforming, in object space.

use std::sync::Arc;

use bvh::{Crossing, Lanes, Ray, RigidTree};
use scene::Mesh;

use crate::accel::deforming_tree::DeformingTree;
use crate::accel::kept_trees::rigid_tree;

/// A mesh and its trees; shared by every object that shows it.
pub(crate) enum MeshTree<'a> {
    Rigid(Arc<RigidTree>),
    Deforming(DeformingTree<'a>),
}

impl<'a> MeshTree<'a> {
    /// Builds the trees of a mesh for rays at times in `[from, to]`.
    pub fn build(mesh: &'a Mesh, from: f64, to: f64) -> Self {
        if mesh.deforms() {
            MeshTree::Deforming(DeformingTree::build(mesh, from, to))
        } else {
            MeshTree::Rigid(rigid_tree(mesh))
        }
    }

    /// The tree of a rigid mesh, whose leaves may be in the world tree.
    #[inline(always)]
    pub fn rigid(&self) -> &RigidTree {
        match self {
            MeshTree::Rigid(tree) => tree,
            MeshTree::Deforming(_) => panic!("only leaves of rigid meshes are in the world tree"),
        }
    }

    /// Size of the stack that [`MeshTree::traverse`] needs.
    pub fn stack_size(&self) -> usize {
        match self {
            MeshTree::Rigid(tree) => tree.stack_size(),
            MeshTree::Deforming(tree) => tree.stack_size(),
        }
    }

    /// Traverses the mesh at a time; see [`RigidTree::traverse`].
    #[inline(always)]
    pub fn traverse<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        stack: &mut [u64],
        ray: &Ray,
        time: f64,
        limit: f64,
        visit: impl FnMut(u32, Crossing) -> f64,
    ) {
        match self {
            MeshTree::Rigid(tree) => tree.traverse::<L, SORTED>(lanes, stack, ray, limit, visit),
            MeshTree::Deforming(tree) => {
                tree.traverse::<L, SORTED>(lanes, stack, ray, time, limit, visit)
            }
        }
    }

    /// Visits every crossing at `0 < t` of the mesh without a tree: the reference for tests of
    /// traversals.
    pub fn visit_all(
        &self,
        mesh: &Mesh,
        ray: &Ray,
        time: f64,
        mut visit: impl FnMut(u32, Crossing),
    ) {
        let ball = match self {
            MeshTree::Rigid(tree) => &tree.ball,
            MeshTree::Deforming(tree) => tree.ball(time),
        };
        let Some(approach) = ball.approach(ray) else {
            return;
        };
        for triangle in 0..mesh.triangles.len() as u32 {
            let corners = mesh.at(time).corners(triangle);
            if let Some(crossing) = approach.cross(corners, f64::INFINITY) {
                visit(triangle, crossing);
            }
        }
    }
}
