//! Real files of every kind: those of `tests/fuzz/fixture`, and the program's output from before the first case, with today's layout.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use walkdir::{DirEntry, WalkDir};

use crate::seeds::in_repository;

/// The fuzzed program.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_shuttertruth");

/// Render options of all pictures.
pub const RENDER: &str = "--quiet --scenes plate --size 16x16 --samples-per-pixel 16";

/// Makes a run, its measured time and baseline, a tuning and a study.
const COMMANDS: [&str; 5] = [
    "run RENDER --filters velocity_gather:departure,mcguire:paper --out out",
    "bench --quiet --size 16x16 --filters velocity_gather:departure --out out",
    "limits accept --out out --reason first --baseline base.json --force",
    "tune search RENDER --filter velocity_gather --objective flip --out tuned --budget 4",
    "tune sensitivity RENDER --filter velocity_gather --objective flip --out study --rows 2",
];

/// Makes the fixture in a temporary folder.
pub fn make() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    copy(&in_repository("tests/fuzz/fixture"), folder.path());
    for line in COMMANDS {
        let line = line.replace("RENDER", RENDER);
        let mut command = Command::new(PROGRAM);
        command.current_dir(&folder).args(line.split(' '));
        let output = command.output().expect("the program can be started");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{line}: {stderr}");
    }
    folder
}

/// Copies a file, or a folder with its content.
pub fn copy(from: &Path, to: &Path) {
    if !from.is_dir() {
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(from, to).unwrap_or_else(|error| panic!("{}: {error}", from.display()));
        return;
    }
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        copy(&path, &to.join(path.file_name().unwrap()));
    }
}

/// Finds the files below a folder with this ending, sorted by path; none if there is no folder.
pub fn files(folder: &Path, end: &str) -> Vec<PathBuf> {
    let entries = WalkDir::new(folder).into_iter().filter_map(Result::ok);
    let mut found: Vec<PathBuf> = entries.map(DirEntry::into_path).collect();
    found.retain(|path| !path.is_dir() && path.to_string_lossy().ends_with(end));
    found.sort();
    found
}
