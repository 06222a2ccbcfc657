//! What an engine would hand to its motion blur: one instant's colour, velocity and depth.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use crate::exr_file::{Channel, ExrFile, Samples, read_exr, write_exr};
use crate::picture::coverage_name;
use crate::{FileError, Image, Plane, Provenance, Raster, Vectors};

/// Depth of a pixel that sees no surface, in metres: finite, so that filters may subtract it.
pub const FAR_DEPTH: f32 = 1.0e10;

/// Which screen motion the velocity buffer holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum VelocityKind {
    /// The derivative at `t = 0`, in pixels per frame.
    #[default]
    Instantaneous,
    /// `x(0) - x(-1)`, the way since the frame before: what engines hand over.
    PreviousFrame,
}

impl VelocityKind {
    /// Every kind.
    pub const ALL: [VelocityKind; 2] = [VelocityKind::Instantaneous, VelocityKind::PreviousFrame];

    /// The word used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            VelocityKind::Instantaneous => "instantaneous",
            VelocityKind::PreviousFrame => "previous_frame",
        }
    }
}

impl fmt::Display for VelocityKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for VelocityKind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL
            .into_iter()
            .find(|kind| kind.name() == text)
            .ok_or_else(|| {
                format!("velocity \"{text}\" is unknown; allowed: instantaneous, previous_frame")
            })
    }
}

/// One instant (`t = 0`) of a scene. All rasters have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Where the frame comes from.
    pub provenance: Provenance,
    /// Exposure that a filter is to blur by, in frames.
    pub exposure: f64,
    /// What `velocity` holds.
    pub velocity_kind: VelocityKind,
    /// Object names; the index is the object id, and 0 is `background`.
    pub objects: Vec<String>,
    /// Radiance, box-filtered over the pixel.
    pub color: Image,
    /// Screen motion over one frame interval at the pixel centre, in pixels; +x right, +y down.
    pub velocity: Vectors,
    /// Distance along the view axis at the pixel centre, in metres; [`FAR_DEPTH`] where nothing is seen.
    pub depth: Plane,
    /// The object seen at the pixel centre.
    pub object_id: Raster<u32>,
    /// Per object: the fraction of the pixel's area in which it is visible at the instant.
    pub coverage: Vec<Plane>,
}

impl Frame {
    /// Pixels per row and rows.
    pub fn size(&self) -> (u32, u32) {
        (self.color.width, self.color.height)
    }

    /// Writes the frame as OpenEXR: `R G B`, `Z`, `velocity.X/Y`, `object.id`, `coverage.<object>`.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        let (width, height) = self.size();
        let mut file = ExrFile::new(width, height);
        file.push_color("", &self.color);
        file.push_plane("Z", &self.depth);
        file.push_plane("velocity.X", &self.velocity.map(|v| v[0]));
        file.push_plane("velocity.Y", &self.velocity.map(|v| v[1]));
        file.channels.push(Channel {
            name: "object.id".into(),
            samples: Samples::U32(self.object_id.pixels.clone()),
        });
        for (object, plane) in self.objects.iter().zip(&self.coverage) {
            file.push_plane(&coverage_name("", object), plane);
        }
        file.set("kind", "frame");
        file.set("exposure", self.exposure);
        file.set("velocity", self.velocity_kind);
        file.set("objects", self.objects.join(" "));
        file.set(
            "convention",
            "pixels per frame interval, +x right, +y down; Z planar metres; scene-linear Rec.709",
        );
        self.provenance.set(&mut file);
        write_exr(path, &file)
    }

    /// Reads a frame that [`Frame::write`] wrote, bit for bit.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let file = read_exr(path)?;
        file.expect_kind("frame")?;
        let objects = file.words("objects")?;
        let ids = file.u32s("object.id")?;
        let coverage = objects
            .iter()
            .map(|object| file.plane(&coverage_name("", object)))
            .collect::<Result<_, _>>()?;
        let [x, y] = [file.plane("velocity.X")?, file.plane("velocity.Y")?];
        Ok(Self {
            provenance: Provenance::from_exr(&file)?,
            exposure: file.get("exposure")?,
            velocity_kind: file.get("velocity")?,
            objects,
            color: file.color("")?,
            velocity: x.zip(&y, |x, y| [*x, *y]),
            depth: file.plane("Z")?,
            object_id: ids,
            coverage,
        })
    }
}
