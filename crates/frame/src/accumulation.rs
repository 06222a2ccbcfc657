//! Accumulations: averages of a few sub-frames, and the ladder of them that errors are measured against.

use std::path::Path;

use crate::exr::{ExrFile, read_exr, write_small_exr};
use crate::shutter::{get_shutter, set_shutter};
use crate::{Alignment, FileError, Picture, Provenance, Shutter, ShutterProfile};

/// Mean of `subframes` instants in the middles of equal parts of the shutter's light. By instant k of N, `(k + 0.5) / N` of the
/// light has passed; for a shutter that opens at once it is `open + (k + 0.5) / N * (close - open)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Accumulation {
    /// Number of instants that were averaged.
    pub subframes: u32,
    /// Means of the even and of the odd replicates.
    pub halves: [Picture; 2],
}

/// Accumulations of 1, 2, 4 .. sub-frames over the same shutter.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    /// Origin of the accumulations.
    pub provenance: Provenance,
    /// The interval that the sub-frames divide.
    pub shutter: Shutter,
    /// Opening and closing of the shutter, and delay between rows.
    pub shutter_profile: ShutterProfile,
    /// Position of that interval relative to the instant.
    pub alignment: Alignment,
    /// Object names; the index is the object id, and 0 is `background`.
    pub objects: Vec<String>,
    /// Accumulations in rising order of sub-frames.
    pub rungs: Vec<Accumulation>,
}

impl Ladder {
    /// Writes the ladder as OpenEXR: layers `n<N>.A` and `n<N>.B` per rung. Takes the ladder, since a copy of the largest thing that
    /// measuring holds would double its memory.
    pub fn write(self, path: &Path) -> Result<(), FileError> {
        let first = &self.rungs.first().expect("a ladder has rungs").halves[0].color;
        let mut file = ExrFile::new(first.width, first.height);
        let subframes: Vec<String> = (self.rungs.iter())
            .map(|rung| rung.subframes.to_string())
            .collect();
        for rung in self.rungs {
            for (half, layer) in rung.halves.into_iter().zip(["A", "B"]) {
                let layer = format!("n{}.{layer}", rung.subframes);
                half.move_to(&mut file, &layer, &self.objects);
            }
        }
        file.set("kind", "ladder");
        set_shutter(&mut file, self.shutter, self.alignment);
        self.shutter_profile.set(&mut file);
        file.set("objects", self.objects.join(" "));
        file.set("subframes", subframes.join(" "));
        self.provenance.set(&mut file);
        // Away from motion all rungs hold the truth's mean.
        write_small_exr(path, file)
    }

    /// Reads a ladder that [`Ladder::write`] wrote, bit for bit.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let mut file = read_exr(path)?;
        file.expect_kind("ladder")?;
        let objects = file.objects()?;
        let (shutter, alignment) = get_shutter(&file)?;
        let mut rungs: Vec<Accumulation> = Vec::new();
        for word in file.words("subframes")? {
            let subframes = word.parse().map_err(|_| {
                file.foreign(format!(
                    "attribute \"subframes\" holds \"{word}\", not a count"
                ))
            })?;
            if rungs.last().map_or(0, |rung| rung.subframes) >= subframes {
                return Err(file.foreign(format!(
                    "attribute \"subframes\" holds \"{word}\" out of order; allowed: rising whole numbers from 1"
                )));
            }
            let mut half = |layer: &str| {
                Picture::take_from(&mut file, &format!("n{subframes}.{layer}"), &objects)
            };
            rungs.push(Accumulation {
                subframes,
                halves: [half("A")?, half("B")?],
            });
        }
        if rungs.is_empty() {
            return Err(
                file.foreign("attribute \"subframes\" is empty; a ladder has rungs".to_owned())
            );
        }
        Ok(Self {
            provenance: Provenance::from_exr(&file)?,
            shutter,
            shutter_profile: ShutterProfile::from_exr(&file)?,
            alignment,
            objects,
            rungs,
        })
    }
}
