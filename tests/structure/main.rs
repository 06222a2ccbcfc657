//! The structure of the sources: no circle of modules in any crate, no long function, and the packages of the design.

mod circles;
mod functions;
mod modules;
mod packages;
mod uses;

use std::fs;
use std::path::{Path, PathBuf};

/// Lists the folders of sources, one per crate.
fn sources() -> Vec<PathBuf> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let entries = fs::read_dir(crates).expect("the repository has crates");
    let mut folders: Vec<PathBuf> = entries.map(|it| it.unwrap().path().join("src")).collect();
    folders.sort();
    folders
}

/// Finds the Rust files below a folder, sorted by path.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => found.extend(rust_files(&path)),
            false if path.extension().is_some_and(|end| end == "rs") => found.push(path),
            false => {}
        }
    }
    found.sort();
    found
}
