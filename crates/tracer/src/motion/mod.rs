//! Cameras, objects and meshes as functions of time.

pub(crate) mod camera;
pub(crate) mod curve;
pub(crate) mod extent;
pub(crate) mod keys;
pub(crate) mod lens;
pub(crate) mod moving;
pub(crate) mod point_motion;
pub(crate) mod pose;
pub(crate) mod poses;
pub(crate) mod screw;
pub(crate) mod shape;
pub(crate) mod slices;
pub(crate) mod sweep;
pub(crate) mod velocity;
