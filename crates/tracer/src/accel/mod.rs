//! The bounding volume hierarchies that rays traverse.

pub(crate) mod binary_tree;
pub(crate) mod build;
pub(crate) mod bvh;
pub(crate) mod collapse;
pub(crate) mod deforming_tree;
pub(crate) mod lanes;
pub(crate) mod mesh_tree;
pub(crate) mod rigid_tree;
pub(crate) mod scene_tree;
pub(crate) mod world_leaves;
pub(crate) mod world_tree;
