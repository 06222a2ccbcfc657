//! What a render asks of motion: views, poses, boxes and velocities.

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
