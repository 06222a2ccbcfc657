//! Hashes the sources of tracer, trees and scenes into the program, so that one tracer's renders
//! are never mistaken for another's.

use std::path::{Path, PathBuf};

/// Crates that pixels depend on, and the variables that name their folders of sources.
const SOURCES: [(&str, &str); 2] = [
    ("bvh", "DEP_SHUTTERTRUTH_BVH_SOURCES"),
    ("scene", "DEP_SHUTTERTRUTH_SCENE_SOURCES"),
];

fn main() {
    let mut hasher = blake3::Hasher::new();
    hash_sources("tracer", Path::new("src"), &mut hasher);
    for (name, variable) in SOURCES {
        let folder = std::env::var(variable).expect("the crate names its sources");
        hash_sources(name, Path::new(&folder), &mut hasher);
    }
    println!(
        "cargo::rustc-env=TRACER_SOURCES={}",
        hasher.finalize().to_hex()
    );
}

fn hash_sources(name: &str, folder: &Path, hasher: &mut blake3::Hasher) {
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut files = Vec::new();
    collect(folder, &mut files);
    files.sort();
    for file in files {
        let text = std::fs::read(&file).expect("a source file can be read");
        let path = file
            .strip_prefix(folder)
            .expect("the file is in the folder");
        let path = path.to_string_lossy().replace('\\', "/");
        hasher.update(format!("{name}/{path}").as_bytes());
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(&text);
    }
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).expect("the source folder can be listed");
    for path in entries.map(|entry| entry.expect("an entry can be read").path()) {
        if path.is_dir() {
            collect(&path, files);
        } else {
            files.push(path);
        }
    }
}
