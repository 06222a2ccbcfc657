//! Hashes of a crate's sources, so that one tracer's renders are never mistaken for another's.

use std::path::{Path, PathBuf};

/// Hashes the sources of the package whose build script calls this. Its code finds the hash in
/// `env!("SOURCE_HASH")`.
pub fn export_source_hash() {
    println!("cargo::rerun-if-changed=src");
    let mut files = Vec::new();
    collect(Path::new("src"), &mut files);
    files.sort();
    let mut hasher = blake3::Hasher::new();
    for file in files {
        let text = std::fs::read(&file).expect("a source file can be read");
        hasher.update(file.to_string_lossy().replace('\\', "/").as_bytes());
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(&text);
    }
    println!(
        "cargo::rustc-env=SOURCE_HASH={}",
        hasher.finalize().to_hex()
    );
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
