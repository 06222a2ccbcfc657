//! The samples of a picture: their places and times, and their means.

pub(crate) mod at_instant;
pub(crate) mod canvas;
pub(crate) mod dilate;
pub(crate) mod eye;
pub(crate) mod finite;
pub(crate) mod means;
pub(crate) mod pilot;
pub(crate) mod render;
pub(crate) mod sample_counts;
pub(crate) mod shutter_sampler;
pub(crate) mod support;
