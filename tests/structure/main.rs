//! The structure of the sources: no circle of modules in any crate, no long function, the
//! packages of the design, and one set of their features.

mod circles;
mod features;
mod functions;
mod modules;
mod packages;
mod uses;
mod walls;

use std::fs;
use std::path::{Path, PathBuf};

/// Lists the folders of sources, one per crate.
fn sources() -> Vec<PathBuf> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let entries = fs::read_dir(crates).expect("the repository has crates");
    let mut folders: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path().join("src"))
        .collect();
    folders.sort();
    folders
}

/// Finds the Rust files below a folder, sorted by path.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => files.extend(rust_files(&path)),
            false if path.extension().is_some_and(|end| end == "rs") => files.push(path),
            false => {}
        }
    }
    files.sort();
    files
}

/// Calls that start a program.
const STARTS: [&str; 3] = [".spawn()", ".output()", ".status()"];

#[test]
fn only_one_crate_starts_programs() {
    for folder in sources() {
        let starts: Vec<PathBuf> = (rust_files(&folder).into_iter())
            .filter(|path| {
                let text = fs::read_to_string(path).expect("a source file");
                let code = text.split("#[cfg(test)]\nmod tests").next();
                let code = code.expect("a text has a first part");
                STARTS.iter().any(|call| code.contains(call))
            })
            .collect();
        if folder.ends_with("process/src") {
            assert!(
                !starts.is_empty(),
                "{STARTS:?} are not what starts programs"
            );
        } else {
            assert!(
                starts.is_empty(),
                "{starts:?}: start programs with process::run, which ends them"
            );
        }
    }
}
