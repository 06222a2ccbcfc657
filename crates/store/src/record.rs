//! Records of finished work with the hash of its inputs, read back while the inputs are the same and nothing has altered the
//! files.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::path::{Path, PathBuf};

use frame::{FileError, write_atomically};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::folder::is_below;

/// Name of a case's record, next to its pictures.
pub const CASE_RECORD: &str = "case.json";

/// A finished piece of work, as its file stores it.
#[derive(Serialize, Deserialize)]
struct Record<T> {
    /// Hash of everything that determines it.
    inputs: String,
    /// Files that belong to it, by their names next to this one, each with the hash of its bytes.
    files: BTreeMap<String, String>,
    /// Result of the work.
    made: T,
}

/// Writes what was `made` of these inputs to `path`, after the `files` next to it have been written.
pub fn put<T: Serialize>(
    path: &Path,
    inputs: String,
    files: &[String],
    made: &T,
) -> Result<(), FileError> {
    let files: BTreeMap<String, String> = (files.iter())
        .map(|name| Ok((name.clone(), hash_file(&path.with_file_name(name))?)))
        .collect::<std::io::Result<_>>()
        .map_err(|source| FileError::io(path, "read what belongs to", source))?;
    let record = Record {
        inputs,
        files,
        made,
    };
    let text = serde_json::to_string_pretty(&record).expect("a record is plain data") + "\n";
    write_atomically(path, text.as_bytes())
}

/// Reads what was made of these inputs. None if there is no such record, if it is broken, or if any of its files is missing
/// or altered.
pub fn look_up<T: DeserializeOwned>(path: &Path, inputs: &str) -> Option<T> {
    let record = read_whole::<T>(path, inputs)?;
    record.altered_files(path).is_empty().then_some(record.made)
}

/// Reads what was made of these inputs, whether or not its files are still there.
pub fn look_up_alone<T: DeserializeOwned>(path: &Path, inputs: &str) -> Option<T> {
    read_whole::<T>(path, inputs).map(|record| record.made)
}

/// Removes altered files of these inputs: the hash in a file may no longer fit its content.
pub fn remove_altered_files(path: &Path, inputs: &str) {
    if let Some(record) = read_whole::<()>(path, inputs) {
        for file in record.altered_files(path) {
            // A missing file is as good as removed.
            let _ = std::fs::remove_file(file);
        }
    }
}

/// Reads a whole record of these inputs. None if it names a file outside its own folder, or beyond a link to a folder: nothing
/// out there is read or removed.
fn read_whole<T: DeserializeOwned>(path: &Path, inputs: &str) -> Option<Record<T>> {
    let found: Record<T> = serde_json::from_slice(&std::fs::read(path).ok()?).ok()?;
    let is_own = |name: &String| is_file_of(&path.with_file_name(""), name);
    (found.inputs == inputs && found.files.keys().all(is_own)).then_some(found)
}

/// Returns whether a name leads to a file in a folder or below it, through no link.
fn is_file_of(folder: &Path, name: &str) -> bool {
    let name = Path::new(name);
    let mut folders = name.ancestors().skip(1);
    is_below(name)
        && folders.all(|inner| inner == Path::new("") || !folder.join(inner).is_symlink())
}

impl<T> Record<T> {
    /// Lists the files that are missing or altered.
    fn altered_files(&self, path: &Path) -> Vec<PathBuf> {
        let paths = (self.files.iter()).map(|(name, hash)| (path.with_file_name(name), hash));
        paths
            .filter(|(path, hash)| !hash_file(path).is_ok_and(|found| found == **hash))
            .map(|(path, _)| path)
            .collect()
    }
}

/// Hashes inputs by their debug output, which includes every field, so that a new one is not forgotten, and numbers that read
/// back equal.
pub fn hash_inputs(inputs: &dyn Debug) -> String {
    hex(format!("{inputs:?}").as_bytes())
}

/// Hashes the running program. Its bytes change with sources, dependencies, compiler and options: everything that may change a
/// number and is no other input. None if the bytes cannot be read.
pub fn hash_program() -> Option<String> {
    hash_file(&std::env::current_exe().ok()?).ok()
}

/// Hashes a file piece by piece: the program, which every run hashes, has a hundred megabytes with debug information.
fn hash_file(path: &Path) -> std::io::Result<String> {
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(std::fs::File::open(path)?)?;
    Ok(hasher.finalize().to_hex().to_string())
}

fn hex(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_that_names_a_file_elsewhere_is_no_record_and_removes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let elsewhere = folder.path().join("mine.txt");
        std::fs::write(&elsewhere, "mine").unwrap();
        let record = folder.path().join("out/frame.json");
        std::fs::create_dir(folder.path().join("out")).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(folder.path(), folder.path().join("out/link")).unwrap();
        for name in [
            #[cfg(unix)]
            "link/mine.txt",
            "../mine.txt",
            elsewhere.to_str().unwrap(),
            "a/../../mine.txt",
            "..",
            "",
        ] {
            let forged = Record {
                inputs: "these".to_owned(),
                files: BTreeMap::from([(name.to_owned(), "0".repeat(64))]),
                made: (),
            };
            std::fs::write(&record, serde_json::to_vec(&forged).unwrap()).unwrap();
            remove_altered_files(&record, "these");
            assert!(elsewhere.exists(), "{name}");
            assert_eq!(look_up::<()>(&record, "these"), None, "{name}");
        }
    }
}
