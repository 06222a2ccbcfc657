//! One job of a plan.

use std::path::{Path, PathBuf};

use serde::Serialize;
use suite::{Error, JobCost};

/// A process of this program: a line of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct Job {
    /// Name, which no other job has.
    pub job: String,
    /// Words behind the program's name.
    pub arguments: Vec<String>,
    /// Files that must be there before it starts.
    pub inputs: Vec<String>,
    /// Files that are there once it has ended.
    pub outputs: Vec<String>,
    /// Expected time on one core, in seconds.
    pub cpu_seconds: f64,
    /// Expected memory at the most, in bytes.
    pub memory: u64,
}

impl Job {
    /// Makes a job of its cost, without words and files.
    pub fn new(job: String, cost: JobCost) -> Self {
        Self {
            job,
            arguments: Vec::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            // Estimates are not known to more.
            cpu_seconds: (cost.cpu_seconds * 10.0).ceil() / 10.0,
            memory: cost.memory,
        }
    }
}

/// Writes a path as a word of a command line.
pub fn path_word(path: &Path) -> Result<String, Error> {
    match path.to_str() {
        Some(text) => Ok(text.to_owned()),
        None => refuse!(
            "{}: is not UTF-8, which the command line of a job must be; rename it",
            path.display()
        ),
    }
}

/// Lists the regular files in a folder and below, in order: inputs of a job.
pub fn files_below(folder: &Path) -> Result<Vec<String>, Error> {
    let fail = |source| frame::FileError::io(folder, "read", source);
    let mut entries: Vec<PathBuf> = (std::fs::read_dir(folder).map_err(fail)?)
        .map(|entry| Ok(entry.map_err(fail)?.path()))
        .collect::<Result<_, Error>>()?;
    entries.sort();
    let mut files = Vec::new();
    for entry in entries {
        if entry.is_symlink() {
            continue;
        } else if entry.is_dir() {
            files.extend(files_below(&entry)?);
        } else if entry.is_file() {
            files.push(path_word(&entry)?);
        }
    }
    Ok(files)
}
