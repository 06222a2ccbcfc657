//! Accumulations: averages of a few sub-frames, and the ladder of them that errors are measured against.

use std::fs;
use std::path::{Path, PathBuf};

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

/// Accumulations of 1, 2, 4 .. sub-frames over the same shutter. Together they take much memory, so measuring keeps one at a
/// time, as a ladder of one rung.
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
    /// Writes the ladder as OpenEXR: layers `n<N>.A` and `n<N>.B` per rung. Consumes the ladder, because a copy would
    /// double the memory of measuring.
    pub fn write(self, path: &Path) -> Result<(), FileError> {
        // Away from motion all rungs equal the truth's mean.
        write_small_exr(path, self.into_exr())
    }

    /// Makes the content of the file that [`Ladder::write`] writes.
    pub fn into_exr(self) -> ExrFile {
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
        file
    }

    /// Writes every rung to a file of its own, `n<N>.exr` in a folder.
    pub fn write_rungs(self, folder: &Path) -> Result<(), FileError> {
        for rung in self.rungs {
            let path = folder.join(rung_file(rung.subframes));
            let alone = Self {
                provenance: self.provenance.clone(),
                shutter_profile: self.shutter_profile.clone(),
                objects: self.objects.clone(),
                rungs: vec![rung],
                ..self
            };
            alone.write(&path)?;
        }
        Ok(())
    }

    /// Reads a ladder bit for bit: a file that [`Ladder::write`] wrote, or all files of a folder that [`Ladder::write_rungs`] wrote.
    /// Refuses a folder whose files belong to several ladders.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        if !path.is_dir() {
            return Self::read_file(path);
        }
        let mut ladder: Option<Self> = None;
        for (subframes, file) in list_rung_files(path)? {
            let rung = Self::read_rung(&file, subframes)?;
            let own_hash = &rung.provenance.content_hash;
            match &mut ladder {
                None => ladder = Some(rung),
                Some(ladder) if ladder.provenance.content_hash == *own_hash => {
                    ladder.rungs.extend(rung.rungs);
                }
                Some(_) => {
                    let reason = "belongs to another ladder than the files next to it".to_owned();
                    return Err(FileError::foreign(&file, reason));
                }
            }
        }
        ladder.ok_or_else(|| FileError::foreign(path, "holds no rung n<N>.exr".to_owned()))
    }

    /// Reads a file of one rung; refuses a rung of another number of sub-frames.
    pub fn read_rung(path: &Path, subframes: u32) -> Result<Self, FileError> {
        let ladder = Self::read_file(path)?;
        match ladder.rungs.as_slice() {
            [rung] if rung.subframes == subframes => Ok(ladder),
            _ => Err(FileError::foreign(
                path,
                format!("does not hold the one rung of {subframes} sub-frames that its name gives"),
            )),
        }
    }

    fn read_file(path: &Path) -> Result<Self, FileError> {
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

/// Names the file of a rung in a ladder's folder.
pub fn rung_file(subframes: u32) -> String {
    format!("n{subframes}.exr")
}

/// Lists the files of a ladder's folder with their numbers of sub-frames, which rise.
fn list_rung_files(folder: &Path) -> Result<Vec<(u32, PathBuf)>, FileError> {
    let listed = fs::read_dir(folder).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let listed = listed.map_err(|source| FileError::io(folder, "read", source))?;
    let mut files: Vec<(u32, PathBuf)> = (listed.iter())
        .filter_map(|entry| {
            let name = entry.file_name();
            let count = name.to_str()?.strip_prefix('n')?.strip_suffix(".exr")?;
            Some((count.parse().ok()?, entry.path()))
        })
        .collect();
    files.sort();
    Ok(files)
}
