//! Options of a frame.

use serde::{Deserialize, Serialize};

use crate::words::words;
use crate::{ExrFile, FileError};

/// Options of a frame. Files name them as the fields are named.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FrameOptions {
    /// Kind of motion in the velocity buffer.
    pub velocity: VelocityKind,
    /// Sampling of colour and coverage.
    pub color: ColorSampling,
    /// True if the background has its velocity, false if it has zero.
    pub sky_velocity: bool,
}

impl Default for FrameOptions {
    fn default() -> Self {
        Self {
            velocity: VelocityKind::default(),
            color: ColorSampling::default(),
            sky_velocity: true,
        }
    }
}

impl FrameOptions {
    /// Writes an attribute per option.
    pub(crate) fn set(&self, file: &mut ExrFile) {
        file.set("velocity", self.velocity);
        file.set("color", self.color);
        file.set("sky_velocity", self.sky_velocity);
    }

    /// Reads the attributes that [`FrameOptions::set`] wrote.
    pub(crate) fn from_exr(file: &ExrFile) -> Result<Self, FileError> {
        Ok(Self {
            velocity: file.get("velocity")?,
            color: file.get("color")?,
            sky_velocity: file.get("sky_velocity")?,
        })
    }
}

/// Kind of screen motion in the velocity buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VelocityKind {
    /// The derivative at `t = 0`, in pixels per frame.
    #[default]
    Instantaneous,
    /// `x(0) - x(-1)`, the motion since the frame before, which engines provide.
    PreviousFrame,
    /// The motion since the frame before as if everything stood still in the world, from depth and
    /// both frames' cameras alone: all that is known without a velocity buffer.
    CameraOnly,
}

/// Sampling of a frame's colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ColorSampling {
    /// Filtered over the pixel's area.
    #[default]
    Antialiased,
    /// Sampled at the pixel's centre, as by a rasteriser without multisampling. Coverage is then 0
    /// or 1.
    Point,
}

words! {
    VelocityKind read as "velocity" {
        Instantaneous => "instantaneous",
        PreviousFrame => "previous_frame",
        CameraOnly => "camera_only",
    }
}

words! {
    ColorSampling read as "color" {
        Antialiased => "antialiased",
        Point => "point",
    }
}
