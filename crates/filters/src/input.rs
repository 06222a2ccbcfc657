//! Input of a filter.

use frame::{Camera, Image, Plane, Raster, Reprojection, Vectors};

use crate::FilterError;

/// Frames per second of frames that do not say their rate, for filters whose convention does not either.
pub(crate) const FRAMES_PER_SECOND: f64 = 60.0;

/// Input of a filter: one instant, as [`frame::Frame`] holds it.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// One or more images that are blurred with the same weights; an object's coverage may travel as a colour.
    pub color: &'a [&'a Image],
    /// Screen motion in pixels per frame, +x right, +y down.
    pub velocity: &'a Vectors,
    /// Distance along the view axis, in metres; above 0.
    pub depth: &'a Plane,
    /// The camera's motion since the frame before, between places of these rasters. Filters that read it refuse to run
    /// without it.
    pub reprojection: Option<Reprojection>,
    /// The camera, for shaders that take its matrices. They refuse to run without it.
    pub camera: Option<Camera>,
    /// Time that the shutter is open, in frames; above 0.
    pub exposure: f64,
    /// Frames per second, where the frame says its rate. It goes before that of a filter's convention.
    pub frames_per_second: Option<f64>,
    /// Changes the noise of filters that have any, and nothing else.
    pub frame_index: u32,
}

impl Input<'_> {
    /// Refuses rasters of another size than `width` x `height`, and values that no frame holds.
    pub(crate) fn check(
        &self,
        filter: &str,
        [width, height]: [u32; 2],
        reads: CameraUse,
    ) -> Result<(), FilterError> {
        let refuse = |reason: String| {
            Err(FilterError::Input {
                filter: filter.to_owned(),
                reason,
            })
        };
        if !(self.exposure.is_finite() && self.exposure > 0.0) {
            return refuse(format!(
                "exposure is {} frames; allowed: above 0 and finite",
                self.exposure
            ));
        }
        let mut rasters = vec![
            ("velocity", size(self.velocity)),
            ("depth", size(self.depth)),
        ];
        rasters.extend(self.color.iter().map(|color| ("color", size(color))));
        for (name, found) in rasters {
            if found != [width, height] {
                return refuse(format!(
                    "{name} has {}x{} pixels; this blur was made for {width}x{height}",
                    found[0], found[1]
                ));
            }
        }
        let finite = |values: &[f32]| values.iter().all(|value| value.is_finite());
        let broken = [
            (
                "velocity",
                "finite",
                self.velocity.pixels.iter().position(|v| !finite(v)),
            ),
            (
                "depth",
                "finite and above 0",
                self.depth
                    .pixels
                    .iter()
                    .position(|z| !z.is_finite() || *z <= 0.0),
            ),
            (
                "color",
                "finite",
                self.color
                    .iter()
                    .find_map(|color| color.pixels.iter().position(|c| !finite(c))),
            ),
        ];
        for (name, allowed, index) in broken {
            if let Some(index) = index {
                let (x, y) = (index as u32 % width, index as u32 / width);
                return refuse(format!("{name} at ({x}, {y}) is not {allowed}"));
            }
        }
        if reads.reprojection && self.reprojection.is_none() {
            return refuse(
                "the frame does not say how the camera moved, which this filter reads; give it an attribute \
                 \"reprojection\" of twelve numbers, or choose another filter"
                    .to_owned(),
            );
        }
        if reads.matrices && self.camera.is_none() {
            return refuse(
                "the frame does not say where its camera was, and this filter takes the camera's matrices; take a frame of \
                 `render`, give it the attributes \"camera\" and \"camera_before\", or choose another filter"
                    .to_owned(),
            );
        }
        Ok(())
    }
}

/// Parts of the camera that a filter reads.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CameraUse {
    /// The camera's motion over the pixels.
    pub reprojection: bool,
    /// Its matrices.
    pub matrices: bool,
}

fn size<T>(raster: &Raster<T>) -> [u32; 2] {
    [raster.width, raster.height]
}
