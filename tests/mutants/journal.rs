//! Measurements of mutants, in files of JSON lines that a later run reads back.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::Path;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use suite::{Case, Error, Run};

/// A mutant on a scene: the subject's key, the mutant's name, the scene. A seed in place of the name means the unchanged filter.
pub type Place = (String, String, String);

pub struct Journal {
    pub changes: Records<Result<Change, String>>,
    pub sound: Records<Run>,
    pub cases: Records<Result<Box<Case>, String>>,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Change {
    /// Root mean square over a region, in noise floors of the truth there; the larger of the moving region and the whole picture.
    pub floors: f64,
    /// Share of the pixels that differ.
    pub share: f64,
}

pub struct Records<T> {
    file: File,
    found: BTreeMap<Place, T>,
}

impl Journal {
    pub fn open(folder: &Path) -> Result<Self, Error> {
        Ok(Self {
            changes: Records::open(&folder.join("changes.jsonl"))?,
            sound: Records::open(&folder.join("sound.jsonl"))?,
            cases: Records::open(&folder.join("cases.jsonl"))?,
        })
    }

    /// Returns whether a mutant makes the same picture of a scene as the unchanged filter.
    pub fn is_same_picture(&self, place: &Place) -> bool {
        matches!(self.changes.get(place), Some(Ok(change)) if change.share == 0.0)
    }
}

impl<T: Serialize + DeserializeOwned> Records<T> {
    fn open(path: &Path) -> Result<Self, Error> {
        let name = |error: std::io::Error| Error::Usage(format!("{}: {error}", path.display()));
        let text = match path.exists() {
            true => fs::read_to_string(path).map_err(name)?,
            false => String::new(),
        };
        // A killed run may leave half a line.
        let found = (text.lines()).filter_map(|line| serde_json::from_str(line).ok());
        let mut options = OpenOptions::new();
        let mut file = options.append(true).create(true).open(path).map_err(name)?;
        if !text.is_empty() && !text.ends_with('\n') {
            file.write_all(b"\n").map_err(name)?;
        }
        let found = found.collect();
        Ok(Self { file, found })
    }

    pub fn get(&self, place: &Place) -> Option<&T> {
        self.found.get(place)
    }

    pub fn add(&mut self, place: Place, record: T) {
        let line = serde_json::to_string(&(&place, &record)).expect("records are plain data");
        writeln!(self.file, "{line}").expect("the journal can be written");
        self.found.insert(place, record);
    }
}
