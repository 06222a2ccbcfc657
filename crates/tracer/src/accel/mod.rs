//! The trees of a scene's meshes, and of the scene.

pub(crate) mod coordinates;
pub(crate) mod deforming_tree;
pub(crate) mod kept_trees;
pub(crate) mod mesh_tree;
pub(crate) mod scene_tree;
pub(crate) mod world_leaves;
