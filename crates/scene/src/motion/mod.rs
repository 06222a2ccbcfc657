//! Cameras, objects and meshes as functions of time.

mod camera;
mod chain;
pub(crate) mod curve;
pub(crate) mod keys;
pub(crate) mod shape;
