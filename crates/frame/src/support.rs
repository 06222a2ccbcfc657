//! Support: pixels where an open shutter sees things, independent of a truth's noise.

use crate::exr::ExrFile;
use crate::{FileError, Plane, Raster, Tile};

/// Visibility in each pixel while the shutter was open, as probe rays found it.
///
/// The probe is a pure function of scene, shutter and picture size: no seed and no number of
/// samples of a truth changes it. It stays the same while a truth converges. All rasters have the
/// same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Support {
    /// Pixels where an object was seen, per object, the background first.
    pub seen: Vec<Raster<bool>>,
    /// Pixels where anything was seen that moves on screen while the shutter is open.
    pub moving: Raster<bool>,
    /// Pixels where anything was seen that the frame of the instant does not show.
    pub unknowable: Raster<bool>,
}

impl Support {
    /// Marks the pixels where object `id` was seen and nothing else.
    pub fn throughout(&self, id: usize) -> Raster<bool> {
        let others = self.seen.iter().enumerate().filter(|(at, _)| *at != id);
        others.fold(self.seen[id].clone(), |seen, (_, other)| {
            seen.zip(other, |seen, other| *seen && !*other)
        })
    }

    /// Copies the pixels of a tile.
    pub fn part(&self, tile: Tile) -> Self {
        Self {
            seen: self.seen.iter().map(|mask| mask.part(tile)).collect(),
            moving: self.moving.part(tile),
            unknowable: self.unknowable.part(tile),
        }
    }

    /// Adds `support.seen.<object>`, `support.moving` and `support.unknowable`, 1 inside the mask
    /// and 0 elsewhere.
    pub(crate) fn push(&self, file: &mut ExrFile, objects: &[String]) {
        let mut push = |name: &str, mask: &Raster<bool>| {
            file.push_plane(&channel(name), &mask.map(|holds| f32::from(*holds)));
        };
        for (object, seen) in objects.iter().zip(&self.seen) {
            push(&format!("seen.{object}"), seen);
        }
        push("moving", &self.moving);
        push("unknowable", &self.unknowable);
    }

    pub(crate) fn from_exr(file: &ExrFile, objects: &[String]) -> Result<Self, FileError> {
        let prefix = channel("");
        if !(file.channels.iter()).any(|channel| channel.name.starts_with(&prefix)) {
            return Err(file.foreign(
                "holds no support (channels support.*), which older versions of shuttertruth did not write; make it anew \
                 with `shuttertruth truths render`"
                    .to_owned(),
            ));
        }
        let mask = |name: &str| {
            let name = channel(name);
            let plane: Plane = file.plane(&name)?;
            match (plane.pixels.iter()).find(|value| **value != 0.0 && **value != 1.0) {
                Some(value) => Err(file.foreign(format!(
                    "channel \"{name}\" holds {value}; allowed: 0 and 1; make the file anew with `shuttertruth truths render`"
                ))),
                None => Ok(plane.map(|value| *value == 1.0)),
            }
        };
        Ok(Self {
            seen: (objects.iter())
                .map(|object| mask(&format!("seen.{object}")))
                .collect::<Result<_, _>>()?,
            moving: mask("moving")?,
            unknowable: mask("unknowable")?,
        })
    }
}

fn channel(name: &str) -> String {
    format!("support.{name}")
}
