//! Input of a filter.

use frame::{Camera, Image, Plane, Raster, Reprojection, Vectors};

use crate::filter::{CameraUse, EXCLUSION, Layer};
use crate::{Filter, FilterError};

/// Frames per second if neither the frame nor the filter's convention says.
pub(crate) const FRAMES_PER_SECOND: f64 = 60.0;

/// Input of a filter: one instant, as in [`frame::Frame`].
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// One or more images that are blurred with the same weights; an object's coverage may be
    /// passed as a colour.
    pub color: &'a [&'a Image],
    /// Screen motion in pixels per frame, +x right, +y down.
    pub velocity: &'a Vectors,
    /// Screen motion from the instant to one frame later, likewise. Filters that read it refuse to
    /// run without it.
    pub velocity_next: Option<&'a Vectors>,
    /// Change of depth over the interval of `velocity`, in metres per frame; above 0 moves away.
    /// Filters that read it refuse to run without it.
    pub velocity_z: Option<&'a Plane>,
    /// 1 on objects that a blur leaves alone, 0 elsewhere. Filters that read it refuse to run
    /// without it.
    pub exclusion: Option<&'a Plane>,
    /// Distance along the view axis, in metres; above 0.
    pub depth: &'a Plane,
    /// The camera's motion since the frame before, between places of these rasters. Filters that
    /// read it refuse to run without it.
    pub reprojection: Option<Reprojection>,
    /// The camera, for shaders that read its matrices. They refuse to run without it.
    pub camera: Option<Camera>,
    /// Time that the shutter is open, in frames; above 0.
    pub exposure: f64,
    /// Frames per second, if the frame says its rate. It takes precedence over a filter's
    /// convention.
    pub frames_per_second: Option<f64>,
    /// Changes the noise of filters that have any, and nothing else.
    pub frame_index: u32,
}

impl Input<'_> {
    /// Refuses rasters of another size than `size`, and impossible values.
    pub(crate) fn check(
        &self,
        filter: &Filter,
        camera: CameraUse,
        size: [u32; 2],
    ) -> Result<(), FilterError> {
        self.check_values(size)
            .and(self.check_camera(filter, camera))
            .and(self.check_further(&filter.further_inputs()))
            .map_err(|reason| FilterError::Input {
                filter: filter.name.clone(),
                reason,
            })
    }

    fn check_values(&self, size: [u32; 2]) -> Result<(), String> {
        if !(self.exposure.is_finite() && self.exposure > 0.0) {
            return Err(format!(
                "exposure is {} frames; allowed: above 0 and finite",
                self.exposure
            ));
        }
        check_raster("velocity", self.velocity, size, "finite", find_broken)?;
        if let Some(next) = self.velocity_next {
            check_raster("velocity_next", next, size, "finite", find_broken)?;
        }
        if let Some(z) = self.velocity_z {
            check_raster("velocity_z", z, size, "finite", |z| {
                let index = frame::find_broken(&z.pixels, f32::NEG_INFINITY)?;
                Some(place_of(z, index))
            })?;
        }
        if let Some(mask) = self.exclusion {
            check_raster(EXCLUSION, mask, size, "from 0 to 1", |mask| {
                let mut pixels = mask.pixels.iter();
                let index = pixels.position(|share| !(0.0..=1.0).contains(share))?;
                Some(place_of(mask, index))
            })?;
        }
        check_raster("depth", self.depth, size, "finite and above 0", |depth| {
            let index = frame::find_broken(&depth.pixels, 0.0)?;
            Some(place_of(depth, index))
        })?;
        (self.color.iter())
            .try_for_each(|color| check_raster("color", color, size, "finite", find_broken))
    }

    /// Refuses a frame that lacks some of the inputs that a filter reads.
    fn check_further(&self, reads: &[Layer]) -> Result<(), String> {
        let is_there = |layer: &&Layer| match layer {
            Layer::Color | Layer::Velocity | Layer::Depth => true,
            Layer::VelocityNext => self.velocity_next.is_some(),
            Layer::VelocityZ => self.velocity_z.is_some(),
            Layer::Exclusion => self.exclusion.is_some(),
        };
        match reads
            .iter()
            .find(|layer| !is_there(layer))
            .map(|layer| layer.name())
        {
            None => Ok(()),
            Some(missing) => Err(format!(
                "the frame has no {missing}, which this filter reads; render it with `truths render --further-velocities`, add it \
                 to the capture, or choose another filter"
            )),
        }
    }

    fn check_camera(&self, filter: &Filter, reads: CameraUse) -> Result<(), String> {
        if reads.reprojection && self.reprojection.is_none() {
            let switches = filter.parameters.iter().filter_map(|parameter| {
                let off = parameter.no_camera_at.as_ref()?;
                Some(format!("set {}={off}, ", parameter.name))
            });
            return Err(format!(
                "the frame does not say how the camera moved, which this filter reads; give it an attribute \
                 \"reprojection\" of twelve numbers, {}or choose another filter",
                switches.collect::<String>()
            ));
        }
        if reads.matrices && self.camera.is_none() {
            return Err(
                "the frame does not say where its camera was, and this filter takes the camera's matrices; take a frame of \
                 `render`, give it the attributes \"camera\" and \"camera_before\", or choose another filter"
                    .to_owned(),
            );
        }
        Ok(())
    }
}

fn check_raster<T>(
    name: &str,
    raster: &Raster<T>,
    [width, height]: [u32; 2],
    allowed: &str,
    find_broken: impl Fn(&Raster<T>) -> Option<[u32; 2]>,
) -> Result<(), String> {
    if [raster.width, raster.height] != [width, height] {
        return Err(format!(
            "{name} has {}x{} pixels; this blur was made for {width}x{height}",
            raster.width, raster.height
        ));
    }
    match find_broken(raster) {
        None => Ok(()),
        Some([x, y]) => Err(format!("{name} at ({x}, {y}) is not {allowed}")),
    }
}

/// Finds the first pixel with a number that is infinite or NaN.
pub(crate) fn find_broken<const N: usize>(raster: &Raster<[f32; N]>) -> Option<[u32; 2]> {
    let index = frame::find_broken(raster.pixels.as_flattened(), f32::NEG_INFINITY)?;
    Some(place_of(raster, index / N))
}

/// Returns the column and the row of a pixel.
fn place_of<T>(raster: &Raster<T>, index: usize) -> [u32; 2] {
    let index = index as u32;
    [index % raster.width, index / raster.width]
}
