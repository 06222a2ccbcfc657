//! Every trial as a line of a file, written before the next one begins.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use filters::Value;
use frame::FileError;
use serde::{Deserialize, Serialize};

use super::Trial;
use crate::Error;
use crate::json::file::read_text;

/// Version of the layout of a journal.
pub const JOURNAL_FORMAT: u32 = 1;

/// The first line: all that trials depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// [`JOURNAL_FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Filter name.
    pub filter: String,
    /// The preset that tuning started from.
    pub start: String,
    /// Its value of every parameter.
    pub values: BTreeMap<String, Value>,
    /// What may change, with its range in words.
    pub vary: BTreeMap<String, String>,
    /// The points that the search begins with, one coordinate per line of `vary` in the order of the filter's parameters.
    pub design: Vec<Vec<f64>>,
    /// Scene names in the order in which candidates meet them, each with the content hash of its truth.
    pub scenes: Vec<(String, String)>,
    /// What is measured: `flip`, `bleed` (lateral), `cost`.
    pub objectives: Vec<String>,
    /// The largest cost, as a ratio to the start's.
    pub cost_at_most: Option<f64>,
    /// The largest lateral bleed of the worst scene, as a ratio to the start's.
    pub bleed_at_most: Option<f64>,
    /// Whether candidates that are clearly worse are dropped.
    pub race: bool,
    /// Of the search's randomness.
    pub seed: u64,
}

/// A journal that can be appended to.
pub struct Journal {
    path: PathBuf,
    file: File,
    /// All trials that it holds.
    pub trials: Vec<Trial>,
}

impl Journal {
    /// Opens the journal at `path`, or begins it. A line that a killed process left half written is cut off: its trial is
    /// done again. Refuses a journal that another command began.
    pub fn open(path: &Path, header: &Header) -> Result<Self, Error> {
        let fail = |action, source| FileError::io(path, action, source);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|error| fail("write", error))?;
        }
        // Read before it is opened for writing: a FIFO would block, and not all of /dev/zero is a journal.
        let text = match path.exists() {
            true => read_text(path)?,
            false => String::new(),
        };
        let mut options = OpenOptions::new();
        let mut file = (options.write(true).create(true).truncate(false))
            .open(path)
            .map_err(|error| fail("write", error))?;
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        // Nothing is cut off before the file is known to be this command's.
        match text[..whole].lines().next() {
            Some(line) => check_header(path, line, header)?,
            None if line_of(header).starts_with(&text) => {}
            None => return Err(refuse(path, 0, "no journal of a tuning")),
        }
        file.set_len(whole as u64)
            .and_then(|()| file.seek(SeekFrom::End(0)))
            .map_err(|error| fail("write", error))?;
        let mut journal = Self {
            path: path.to_owned(),
            file,
            trials: Vec::new(),
        };
        let mut lines = text[..whole].lines().enumerate();
        if lines.next().is_none() {
            journal.write(header)?;
        }
        for (index, line) in lines {
            let trial: Trial = serde_json::from_str(line)
                .map_err(|error| refuse(path, index, &format!("no trial: {error}")))?;
            (trial.check(header, journal.trials.len()))
                .map_err(|reason| refuse(path, index, &reason))?;
            journal.trials.push(trial);
        }
        Ok(journal)
    }

    /// Writes a trial, down to the disk.
    pub fn append(&mut self, trial: Trial) -> Result<(), Error> {
        self.write(&trial)?;
        self.trials.push(trial);
        Ok(())
    }

    fn write(&mut self, line: &impl Serialize) -> Result<(), Error> {
        let text = line_of(line);
        let written = (self.file.write_all(text.as_bytes())).and_then(|()| self.file.sync_data());
        written.map_err(|source: io::Error| {
            Error::Usage(format!(
                "{}: cannot be written: {source}; its {} whole trials are safe: make room and run the same command again, \
                 which goes on after them",
                self.path.display(),
                self.trials.len()
            ))
        })
    }
}

/// A line of the journal with its end.
fn line_of(content: &impl Serialize) -> String {
    serde_json::to_string(content).expect("a line is plain data") + "\n"
}

fn refuse(path: &Path, index: usize, reason: &str) -> Error {
    Error::Usage(format!(
        "{}:{}: {reason}; choose another --out, or delete the file to begin anew",
        path.display(),
        index + 1
    ))
}

/// Names the first thing that differs.
fn check_header(path: &Path, line: &str, expected: &Header) -> Result<(), Error> {
    let found: serde_json::Value = serde_json::from_str(line)
        .map_err(|error| refuse(path, 0, &format!("no journal of a tuning: {error}")))?;
    let expected = serde_json::to_value(expected).expect("a header is plain data");
    let fields = expected.as_object().expect("a header is a table");
    for (name, expected) in fields {
        let found = &found[name];
        if found != expected {
            let reason = format!(
                "it was begun with another {name}: found {found}, this command has {expected}"
            );
            return Err(refuse(path, 0, &reason));
        }
    }
    Ok(())
}
