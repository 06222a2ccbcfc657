//! Accumulations: averages of a few sub-frames, and the ladder of them that errors are measured
//! against.

use std::fs;
use std::path::{Path, PathBuf};

use crate::exr::{ExrFile, read_exr, write_small_exr};
use crate::shutter::{get_shutter, set_shutter};
use crate::{Alignment, FileError, Picture, Provenance, Shutter, ShutterProfile};

/// Upper limit on the groups of samples that scores' intervals leave out in turn. A group is left
/// out of a frame, a truth and its ladder together.
pub const MOST_GROUPS: u32 = 4;

/// Mean of `subframes` instants in the middles of equal parts of the shutter's light. By instant k
/// of N, `(k + 0.5) / N` of the light has passed; for a shutter that opens at once it is `open + (k
/// + 0.5) / N * (close - open)`.
///
/// It is stored as its difference from the picture of the whole shutter. Both were rendered with
/// the same random numbers, so the difference has little noise, and none of the truth's.
#[derive(Clone, Debug, PartialEq)]
pub struct Accumulation {
    /// Number of instants that were averaged.
    pub subframes: u32,
    /// Differences from the whole shutter's picture: radiance and shares that may be negative. Each
    /// is the mean of an independent group of samples; there are at least two.
    pub groups: Vec<Picture>,
}

impl Accumulation {
    /// Averages the differences over all groups.
    pub fn difference(&self) -> Picture {
        Picture::mean(&self.groups)
    }

    /// Averages the even and the odd groups. Of one group alone, both halves are that group, and
    /// its noise counts as error.
    pub fn halves(&self) -> [Picture; 2] {
        let odd = usize::from(self.groups.len() > 1);
        [0, odd].map(|first| Picture::mean(self.groups.iter().skip(first).step_by(2)))
    }

    /// Makes the picture of the accumulation from the truth's mean. Its noise is the truth's and
    /// that of the difference. Nothing is clamped, which would bias it: noise can take dark colours
    /// and small shares slightly below 0.
    pub fn picture(&self, mean: &Picture) -> Picture {
        mean.plus(&self.difference())
    }

    /// Leaves one group out; panics if no group would be left.
    pub fn without(&self, group: usize) -> Self {
        assert!(self.groups.len() > 1, "one group cannot be left out");
        let others = self.groups.iter().enumerate();
        let others = others.filter(|(index, _)| *index != group);
        Self {
            subframes: self.subframes,
            groups: others.map(|(_, picture)| picture.clone()).collect(),
        }
    }
}

/// Accumulations of 1, 2, 4 .. sub-frames over the same shutter. Together they take much memory, so
/// measuring keeps one at a time, as a ladder of one rung.
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
    /// Leaves one group of samples out of every rung; panics if no group would be left.
    pub fn without(&self, group: usize) -> Self {
        Self {
            provenance: self.provenance.clone(),
            shutter_profile: self.shutter_profile.clone(),
            objects: self.objects.clone(),
            rungs: (self.rungs.iter())
                .map(|rung| rung.without(group))
                .collect(),
            ..*self
        }
    }

    /// Writes the ladder as OpenEXR: layers `n<N>.0`, `n<N>.1` .. per rung, one per group. Consumes
    /// the ladder, because a copy would double the memory of measuring.
    pub fn write(self, path: &Path) -> Result<(), FileError> {
        // Away from motion all differences are 0.
        write_small_exr(path, self.into_exr())
    }

    /// Makes the content of the file that [`Ladder::write`] writes.
    pub fn into_exr(self) -> ExrFile {
        let first = &self.rungs.first().expect("a ladder has rungs").groups[0].color;
        let mut file = ExrFile::new(first.width, first.height);
        let subframes: Vec<String> = (self.rungs.iter())
            .map(|rung| rung.subframes.to_string())
            .collect();
        let groups = self.rungs[0].groups.len();
        for rung in self.rungs {
            assert_eq!(rung.groups.len(), groups, "rungs have as many groups");
            for (index, group) in rung.groups.into_iter().enumerate() {
                let layer = layer_name(rung.subframes, index);
                group.move_to(&mut file, &layer, &self.objects);
            }
        }
        file.set("kind", "ladder");
        set_shutter(&mut file, self.shutter, self.alignment);
        self.shutter_profile.set(&mut file);
        file.set("objects", self.objects.join(" "));
        file.set("subframes", subframes.join(" "));
        file.set("groups", groups);
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

    /// Reads a ladder bit for bit: a file that [`Ladder::write`] wrote, or all files of a folder
    /// that [`Ladder::write_rungs`] wrote. Refuses a folder whose files belong to several ladders.
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
        let groups = read_groups(&file)?;
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
            let group = |index| {
                let layer = layer_name(subframes, index);
                Picture::take_from(&mut file, &layer, &objects)
            };
            rungs.push(Accumulation {
                subframes,
                groups: (0..groups).map(group).collect::<Result<_, _>>()?,
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

/// Reads the number of groups of every rung.
fn read_groups(file: &ExrFile) -> Result<usize, FileError> {
    let old = "lacks the attribute \"groups\", which ladders of older versions of shuttertruth have not; make it anew with \
               `shuttertruth run` or `shuttertruth truths render --ladders`";
    let count = file
        .get("groups")
        .map_err(|_| file.foreign(old.to_owned()))?;
    match count {
        0 => Err(file.foreign("attribute \"groups\" holds 0; allowed: from 1".to_owned())),
        _ => Ok(count),
    }
}

/// Names the layer of a group of samples of a rung.
fn layer_name(subframes: u32, group: usize) -> String {
    format!("n{subframes}.{group}")
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
