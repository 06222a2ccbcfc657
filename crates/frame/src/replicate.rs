//! One complete, independent render of a shutter interval: the unit in which truths are rendered, kept and shared.

use std::path::Path;

use crate::exr_file::{ExrFile, read_exr, write_exr};
use crate::truth::{get_shutter, set_shutter};
use crate::{
    Alignment, AtInstant, FileError, Picture, Provenance, Shutter, ShutterProfile, Support,
};

/// One of the renders that a [`Truth`](crate::Truth) is the mean of. All rasters have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Replicate {
    /// Where it comes from; its content hash is that of all replicates of the same truth, whatever their number.
    pub provenance: Provenance,
    /// Which one it is, from 0: it chooses the random numbers.
    pub index: u32,
    /// The interval integrated over.
    pub shutter: Shutter,
    /// How the shutter opens and closes, and how rows follow one another.
    pub shutter_profile: ShutterProfile,
    /// Where that interval lies relative to the instant.
    pub alignment: Alignment,
    /// Object names; the index is the object id, and 0 is `background`.
    pub objects: Vec<String>,
    /// Per object, whether it moves on screen while the shutter is open.
    pub moving: Vec<bool>,
    /// Radiance and visibility integrated over the shutter.
    pub picture: Picture,
    /// The same as it was at the instant.
    pub at_instant: AtInstant,
    /// What scores are pooled over: the same for all replicates of a scene, shutter and size.
    pub support: Support,
}

impl Replicate {
    /// Writes the replicate as OpenEXR: `R G B`, `coverage.<object>`, and what [`AtInstant`] and [`Support`]
    /// hold.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        let color = &self.picture.color;
        let mut file = ExrFile::new(color.width, color.height);
        self.picture.push(&mut file, "", &self.objects);
        self.at_instant.push(&mut file, "");
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
        write_exr(path, &file)
    }

    /// What the other has otherwise, though replicates of one truth share it; none where they are alike. Both are whole: what
    /// one of them holds has one size.
    pub(crate) fn difference(&self, other: &Replicate) -> Option<&'static str> {
        if !self.picture.color.same_size(&other.picture.color) {
            Some("size")
        } else if (&self.objects, &self.moving) != (&other.objects, &other.moving) {
            Some("list of objects")
        } else if (self.shutter, self.alignment) != (other.shutter, other.alignment)
            || self.shutter_profile != other.shutter_profile
        {
            Some("shutter")
        } else if self.provenance.samples_per_pixel != other.provenance.samples_per_pixel {
            Some("number of samples")
        } else {
            None
        }
    }

    /// Reads a replicate that [`Replicate::write`] wrote, bit for bit.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let file = read_exr(path)?;
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
            picture: Picture::from_exr(&file, "", &objects)?,
            at_instant: AtInstant::from_exr(&file, "")?,
            support: Support::from_exr(&file, &objects)?,
            objects,
        })
    }
}
