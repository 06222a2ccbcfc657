//! Replicates: complete, independent renders of a shutter interval. Truths are rendered,
//! stored and shared as replicates.

use std::path::Path;

use crate::exr::{ExrFile, read_exr, write_small_exr};
use crate::shutter::{get_shutter, set_shutter};
use crate::{
    Alignment, AtInstant, FileError, Picture, Plane, Provenance, Shutter, ShutterProfile, Support,
};

/// One of the renders that a [`Truth`](crate::Truth) is the mean of. All rasters have the same
/// size.
#[derive(Clone, Debug, PartialEq)]
pub struct Replicate {
    /// Origin of the replicate; all replicates of one truth have the same content hash, whatever
    /// their number.
    pub provenance: Provenance,
    /// Index from 0, which chooses the random numbers.
    pub index: u32,
    /// The interval integrated over.
    pub shutter: Shutter,
    /// Opening and closing of the shutter, and delay between rows.
    pub shutter_profile: ShutterProfile,
    /// Position of that interval relative to the instant.
    pub alignment: Alignment,
    /// Object names; the index is the object id, and 0 is `background`.
    pub objects: Vec<String>,
    /// Per object, true if it moves on screen while the shutter is open.
    pub moving: Vec<bool>,
    /// Radiance and visibility integrated over the shutter.
    pub picture: Picture,
    /// State at the instant of everything that the shutter saw.
    pub at_instant: AtInstant,
    /// Samples per pixel: the same for all replicates of a scene, exposure, size and seed.
    pub samples: Plane,
    /// Pixels that scores are pooled over: the same for all replicates of a scene, shutter and
    /// size.
    pub support: Support,
}

impl Replicate {
    /// Writes the replicate as OpenEXR: `R G B`, `coverage.<object>`, `samples`, and the channels
    /// of [`AtInstant`] and [`Support`].
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        write_small_exr(path, self.to_exr())
    }

    /// Makes the content of the file that [`Replicate::write`] writes.
    pub fn to_exr(&self) -> ExrFile {
        let color = &self.picture.color;
        let mut file = ExrFile::new(color.width, color.height);
        self.picture.push(&mut file, "", &self.objects);
        self.at_instant.push(&mut file, "");
        file.push_plane("samples", &self.samples);
        self.support.push(&mut file, &self.objects);
        file.set("kind", "replicate");
        file.set("replicate", self.index);
        set_shutter(&mut file, self.shutter, self.alignment);
        self.shutter_profile.set(&mut file);
        file.set("objects", self.objects.join(" "));
        let moving: Vec<&str> = (self.objects.iter().zip(&self.moving))
            .filter(|(_, moves)| **moves)
            .map(|(object, _)| object.as_str())
            .collect();
        file.set("moving", moving.join(" "));
        self.provenance.set(&mut file);
        file
    }

    /// Names a property that replicates of one truth share and these two do not; `None` if there is
    /// none.
    pub(crate) fn find_difference(&self, other: &Replicate) -> Option<&'static str> {
        let shutter = |replicate: &Replicate| {
            (
                replicate.shutter,
                replicate.alignment,
                replicate.shutter_profile.clone(),
            )
        };
        let samples = |replicate: &Replicate| replicate.provenance.samples_per_pixel;
        let same = [
            ("size", self.picture.color.same_size(&other.picture.color)),
            (
                "list of objects",
                self.objects == other.objects && self.moving == other.moving,
            ),
            ("shutter", shutter(self) == shutter(other)),
            (
                "number of samples",
                samples(self) == samples(other) && self.samples == other.samples,
            ),
            ("support", self.support == other.support),
        ];
        same.into_iter()
            .find(|(_, is_same)| !is_same)
            .map(|(what, _)| what)
    }

    /// Reads a replicate that [`Replicate::write`] wrote, bit for bit.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let mut file = read_exr(path)?;
        file.expect_kind("replicate")?;
        let objects = file.objects()?;
        let moving = file.words("moving")?;
        let (shutter, alignment) = get_shutter(&file)?;
        Ok(Self {
            provenance: Provenance::from_exr(&file)?,
            index: file.get("replicate")?,
            shutter,
            shutter_profile: ShutterProfile::from_exr(&file)?,
            alignment,
            moving: objects.iter().map(|name| moving.contains(name)).collect(),
            picture: Picture::take_from(&mut file, "", &objects)?,
            at_instant: AtInstant::from_exr(&file, "")?,
            samples: file.samples_per_pixel()?,
            support: Support::from_exr(&file, &objects)?,
            objects,
        })
    }
}
