//! The frame that an engine would hand to its motion blur: colour, velocity and depth of one
//! instant.

use std::path::Path;

use crate::exr::{Channel, ExrFile, Samples, read_exr, write_small_exr};
use crate::{
    Alignment, Camera, Display, FileError, FrameOptions, Image, Picture, Plane, Provenance, Raster,
    Reprojection, Size, Vectors,
};

/// Depth of a pixel that sees no surface, in metres: finite, so that filters may subtract it.
pub const FAR_DEPTH: f32 = 1.0e10;

/// One instant (`t = 0`) of a scene. All rasters have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Origin of the frame.
    pub provenance: Provenance,
    /// Exposure that a filter is to blur by, in frames.
    pub exposure: f64,
    /// Frames per second that the scene was filmed at; none if that is the rate of its file.
    pub frames_per_second: Option<f64>,
    /// Kind of motion in `velocity`, sampling of `color` and `coverage`, motion of the background.
    pub options: FrameOptions,
    /// Pixels by which all rasters extend beyond the picture on every side.
    pub guard_band: u32,
    /// The camera's motion since the frame before, between places of the picture without its guard
    /// band.
    pub reprojection: Reprojection,
    /// The camera; none in a frame that another program rendered.
    pub camera: Option<Camera>,
    /// Exposures at which the scene is shown and compared.
    pub display: Display,
    /// Object names; the index is the object id, and 0 is `background`.
    pub objects: Vec<String>,
    /// Radiance, box-filtered over the pixel or sampled at its centre.
    pub color: Image,
    /// Screen motion over one frame interval at the pixel centre, in pixels; +x right, +y down.
    pub velocity: Vectors,
    /// Screen motion from the instant to one frame later, of the same points and in the same units.
    /// Few filters read it; none in a frame that was not asked for it.
    pub velocity_next: Option<Vectors>,
    /// Change of depth over the interval of `velocity`, in metres per frame; above 0 moves away.
    /// Few filters read it, as above.
    pub velocity_z: Option<Plane>,
    /// Distance along the view axis at the pixel centre, in metres; [`FAR_DEPTH`] where nothing is
    /// seen.
    pub depth: Plane,
    /// The object seen at the pixel centre.
    pub object_id: Raster<u32>,
    /// Fraction of the pixel's area in which an object is visible at the instant, per object; 0 or
    /// 1 if colour is sampled at the centre.
    pub coverage: Vec<Plane>,
    /// Samples per pixel; none in a frame that another program rendered.
    pub samples: Option<Plane>,
}

impl Frame {
    /// Returns the size of its rasters, guard band included.
    pub fn size(&self) -> Size {
        self.color.size()
    }

    /// Removes the guard band, so that pixels match the truth's.
    pub fn cropped(&self) -> Frame {
        let band = self.guard_band;
        Frame {
            provenance: self.provenance.clone(),
            objects: self.objects.clone(),
            guard_band: 0,
            color: self.color.cropped(band),
            velocity: self.velocity.cropped(band),
            velocity_next: self
                .velocity_next
                .as_ref()
                .map(|velocity| velocity.cropped(band)),
            velocity_z: self.velocity_z.as_ref().map(|plane| plane.cropped(band)),
            depth: self.depth.cropped(band),
            object_id: self.object_id.cropped(band),
            coverage: self
                .coverage
                .iter()
                .map(|plane| plane.cropped(band))
                .collect(),
            samples: self.samples.as_ref().map(|plane| plane.cropped(band)),
            ..*self
        }
    }

    /// Copies colour and coverage: the picture of a filter that does nothing.
    pub fn picture(&self) -> Picture {
        Picture {
            color: self.color.clone(),
            coverage: self.coverage.clone(),
        }
    }

    /// Keeps colour and coverage alone.
    pub fn into_picture(self) -> Picture {
        Picture {
            color: self.color,
            coverage: self.coverage,
        }
    }

    /// Copies the frame with another picture's colour and coverage.
    pub fn showing(&self, picture: &Picture) -> Frame {
        Frame {
            color: picture.color.clone(),
            coverage: picture.coverage.clone(),
            ..self.clone()
        }
    }

    /// Writes the frame as OpenEXR: `R G B`, `Z`, `velocity.X/Y`, `object.id`, `coverage.<object>`,
    /// `samples`; `velocity_next.X/Y` and `velocity_z` where it has them.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        write_small_exr(path, self.to_exr())
    }

    /// Makes the content of the file that [`Frame::write`] writes.
    pub fn to_exr(&self) -> ExrFile {
        let Size { width, height } = self.size();
        let mut file = ExrFile::new(width, height);
        self.picture().move_to(&mut file, "", &self.objects);
        file.push_plane("Z", &self.depth);
        file.push_vectors("velocity", &self.velocity);
        if let Some(next) = &self.velocity_next {
            file.push_vectors("velocity_next", next);
        }
        if let Some(z) = &self.velocity_z {
            file.push_plane("velocity_z", z);
        }
        file.channels.push(Channel {
            name: "object.id".into(),
            samples: Samples::U32(self.object_id.pixels.clone()),
        });
        if let Some(samples) = &self.samples {
            file.push_plane("samples", samples);
        }
        file.set("kind", "frame");
        file.set("exposure", self.exposure);
        if let Some(rate) = self.frames_per_second {
            file.set("frames_per_second", rate);
        }
        self.options.set(&mut file);
        file.set("guard_band", self.guard_band);
        self.reprojection.set(&mut file);
        if let Some(camera) = &self.camera {
            camera.set(&mut file);
        }
        self.display.set(&mut file);
        file.set("objects", self.objects.join(" "));
        file.set(
            "convention",
            "pixels per frame interval, +x right, +y down; Z planar metres; scene-linear Rec.709",
        );
        self.provenance.set(&mut file);
        file
    }

    /// Reads a frame that [`Frame::write`] wrote, bit for bit.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let mut file = read_exr(path)?;
        file.expect_kind("frame")?;
        let objects = file.objects()?;
        let ids = file.u32s("object.id")?;
        let Picture { color, coverage } = Picture::take_from(&mut file, "", &objects)?;
        Ok(Self {
            provenance: Provenance::from_exr(&file)?,
            exposure: read_exposure(&file)?,
            frames_per_second: read_frame_rate(&file)?,
            options: FrameOptions::from_exr(&file)?,
            guard_band: read_guard_band(&file)?,
            reprojection: Reprojection::from_exr(&file)?,
            camera: Camera::from_exr(&file)?,
            display: Display::from_exr(&file)?,
            objects,
            color,
            velocity: file.vectors("velocity")?,
            velocity_next: file.optional("velocity_next.X", || file.vectors("velocity_next"))?,
            velocity_z: file.optional("velocity_z", || file.plane("velocity_z"))?,
            depth: file.plane("Z")?,
            object_id: ids,
            coverage,
            samples: file.optional("samples", || file.plane("samples"))?,
        })
    }
}

/// Reads an exposure; refuses one that no shutter has.
fn read_exposure(file: &ExrFile) -> Result<f64, FileError> {
    let exposure = file.get("exposure")?;
    let checked = Alignment::Trailing.shutter(exposure);
    checked.map_err(|error| file.foreign(error.to_string()))?;
    Ok(exposure)
}

/// Reads a frame rate; none if the file has none. Refuses an invalid one.
pub fn read_frame_rate(file: &ExrFile) -> Result<Option<f64>, FileError> {
    const NAME: &str = "frames_per_second";
    if !file.attributes.contains_key(NAME) {
        return Ok(None);
    }
    let rate: f64 = file.get(NAME)?;
    if rate.is_finite() && rate > 0.0 {
        Ok(Some(rate))
    } else {
        Err(file.foreign(format!(
            "attribute \"{NAME}\" holds {rate}; allowed: a finite number above 0"
        )))
    }
}

/// Reads a guard band; refuses one that leaves no picture inside it.
fn read_guard_band(file: &ExrFile) -> Result<u32, FileError> {
    let band: u32 = file.get("guard_band")?;
    let least = file.width.min(file.height);
    if band.checked_mul(2).is_some_and(|both| both < least) {
        Ok(band)
    } else {
        Err(file.foreign(format!(
            "attribute \"guard_band\" holds {band}; allowed: less than half of {}x{} pixels",
            file.width, file.height
        )))
    }
}
