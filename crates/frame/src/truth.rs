//! What a camera with an open shutter would have seen.

use std::path::Path;

use crate::exr_file::{ExrFile, read_exr, write_exr};
use crate::{Alignment, FileError, Image, Picture, Plane, Provenance, Shutter};

/// Radiance and visibility integrated over the shutter, with its own noise. All rasters have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Where the truth comes from.
    pub provenance: Provenance,
    /// The interval integrated over.
    pub shutter: Shutter,
    /// Where that interval lies relative to the instant.
    pub alignment: Alignment,
    /// Object names; the index is the object id, and 0 is `background`.
    pub objects: Vec<String>,
    /// Means of the even and of the odd replicates.
    pub halves: [Picture; 2],
    /// Standard error of [`Truth::mean`], from the spread of the replicates.
    pub standard_error: Image,
    /// Fraction of (shutter x pixel area) whose visible surface moves on screen while the shutter is open.
    pub motion: Plane,
}

impl Truth {
    /// Pixels per row and rows.
    pub fn size(&self) -> (u32, u32) {
        (self.motion.width, self.motion.height)
    }

    /// How far from any motion blur is looked for, in pixels: bleed leaves the support, but not without end. Scores of
    /// the moving region pool so far, and accumulations are rendered so far.
    pub fn motion_margin(&self) -> u32 {
        (f64::from(self.motion.height) / 15.0).round() as u32
    }

    /// Mean of all replicates.
    pub fn mean(&self) -> Picture {
        Picture::mean(&self.halves)
    }

    /// Writes the truth as OpenEXR: the mean as `R G B` and `coverage.<object>`, the halves as layers `A` and `B`,
    /// `stderr.R/G/B`, and `motion`.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        let (width, height) = self.size();
        let mut file = ExrFile::new(width, height);
        self.mean().push(&mut file, "", &self.objects);
        self.halves[0].push(&mut file, "A", &self.objects);
        self.halves[1].push(&mut file, "B", &self.objects);
        file.push_color("stderr", &self.standard_error);
        file.push_plane("motion", &self.motion);
        file.set("kind", "truth");
        set_shutter(&mut file, self.shutter, self.alignment);
        file.set("objects", self.objects.join(" "));
        file.set(
            "convention",
            "coverage is the fraction of shutter x pixel area; scene-linear Rec.709",
        );
        self.provenance.set(&mut file);
        write_exr(path, &file)
    }

    /// Reads a truth that [`Truth::write`] wrote, bit for bit.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let file = read_exr(path)?;
        file.expect_kind("truth")?;
        let objects = file.words("objects")?;
        let (shutter, alignment) = get_shutter(&file)?;
        Ok(Self {
            provenance: Provenance::from_exr(&file)?,
            shutter,
            alignment,
            halves: [
                Picture::from_exr(&file, "A", &objects)?,
                Picture::from_exr(&file, "B", &objects)?,
            ],
            objects,
            standard_error: file.color("stderr")?,
            motion: file.plane("motion")?,
        })
    }
}

pub(crate) fn set_shutter(file: &mut ExrFile, shutter: Shutter, alignment: Alignment) {
    file.set("shutter_open", shutter.open);
    file.set("shutter_close", shutter.close);
    file.set("alignment", alignment);
}

pub(crate) fn get_shutter(file: &ExrFile) -> Result<(Shutter, Alignment), FileError> {
    let shutter = Shutter::new(file.get("shutter_open")?, file.get("shutter_close")?)
        .map_err(|error| file.foreign(error.to_string()))?;
    Ok((shutter, file.get("alignment")?))
}
