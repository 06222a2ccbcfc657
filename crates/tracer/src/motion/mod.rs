//! Views, poses, boxes and velocities of a scene in motion.

pub(crate) mod extent;
pub(crate) mod lens;
pub(crate) mod moving;
pub(crate) mod point_motion;
pub(crate) mod pose;
pub(crate) mod poses;
pub(crate) mod screw;
pub(crate) mod slices;
pub(crate) mod sweep;
pub(crate) mod velocity;
pub(crate) mod view;
