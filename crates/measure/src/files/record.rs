//! Records of finished work with hashes of its inputs, of its files and of the record itself. A
//! record is read back while the inputs are the same and nothing has altered the files or the
//! record.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use frame::{Alignment, FileError, open_regular, read_bounded, write_atomically};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::files::folder::is_below;
use crate::files::json::MAX_JSON_BYTES;
use crate::files::place::MAX_TAKEN_BYTES;

/// Name of a case's record, next to its pictures.
pub const CASE_RECORD: &str = "case.json";

/// Names the record of a truth's own errors, in a scene's folder. It is hidden, since it is no
/// result: runs that are merged leave it behind.
pub fn errors_file(alignment: Alignment) -> String {
    format!(".shuttertruth.errors_{alignment}.json")
}

/// A finished piece of work, as its file stores it.
#[derive(Serialize, Deserialize)]
struct Record<T> {
    /// Hash of this text with an empty hash. It is the first key, so that no other text is taken
    /// for it.
    hash: String,
    /// Hash of everything that determines it.
    inputs: String,
    /// Files that belong to it, by their names next to this one, each with the hash of its bytes.
    files: BTreeMap<String, String>,
    /// Result of the work.
    made: T,
}

/// Writes what was `made` of these inputs to `path`, after the `files` next to it have been
/// written.
pub fn put<T: Serialize>(
    path: &Path,
    inputs: String,
    files: &[String],
    made: &T,
) -> Result<(), FileError> {
    let files: BTreeMap<String, String> = (files.iter())
        .map(|name| Ok((name.clone(), hash_file(&path.with_file_name(name))?)))
        .collect::<Result<_, FileError>>()?;
    let record = Record {
        hash: String::new(),
        inputs,
        files,
        made,
    };
    write_atomically(path, record.text().as_bytes())
}

/// Reads what was made of these inputs. None if there is no such record, if it is broken, or if any
/// of its files is missing or altered.
pub fn look_up<T: DeserializeOwned>(path: &Path, inputs: &str) -> Option<T> {
    let record = read_whole::<T>(path, inputs)?;
    record.altered_files(path).is_empty().then_some(record.made)
}

/// Reads what was made of these inputs, whether or not its files are still there.
pub fn look_up_alone<T: DeserializeOwned>(path: &Path, inputs: &str) -> Option<T> {
    read_whole::<T>(path, inputs).map(|record| record.made)
}

/// A record that was read back.
pub struct StoredRecord<T> {
    /// Hash of everything that determines it.
    pub inputs: String,
    /// Result of the work.
    pub made: T,
    /// Its files that are missing or altered.
    pub altered: Vec<PathBuf>,
}

/// Reads a record of any inputs. None if there is none, or if it is broken or altered.
pub fn read_record<T: DeserializeOwned>(path: &Path) -> Option<StoredRecord<T>> {
    let record = read_unaltered::<T>(path)?;
    Some(StoredRecord {
        altered: record.altered_files(path),
        inputs: record.inputs,
        made: record.made,
    })
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

/// Reads a whole record of these inputs.
fn read_whole<T: DeserializeOwned>(path: &Path, inputs: &str) -> Option<Record<T>> {
    read_unaltered(path).filter(|record| record.inputs == inputs)
}

/// Reads a whole record. None if it is altered, or if it names a file outside its own folder, or
/// beyond a link to a folder: nothing out there is read or removed.
fn read_unaltered<T: DeserializeOwned>(path: &Path) -> Option<Record<T>> {
    let text = String::from_utf8(read_bounded(path, MAX_JSON_BYTES).ok()?).ok()?;
    let record: Record<T> = serde_json::from_str(&text).ok()?;
    let is_below = |name: &String| is_file_of(&path.with_file_name(""), name);
    let is_whole = hex(text.replacen(&record.hash, "", 1).as_bytes()) == record.hash
        && record.files.keys().all(is_below);
    is_whole.then_some(record)
}

/// Returns whether a name leads to a file in a folder or below it, through no link.
fn is_file_of(folder: &Path, name: &str) -> bool {
    let name = Path::new(name);
    let mut folders = name.ancestors().skip(1);
    is_below(name)
        && folders.all(|inner| inner == Path::new("") || !folder.join(inner).is_symlink())
}

impl<T: Serialize> Record<T> {
    /// Formats the record with its hash.
    fn text(mut self) -> String {
        let format = |record: &Self| {
            serde_json::to_string_pretty(record).expect("a record is plain data") + "\n"
        };
        self.hash = hex(format(&self).as_bytes());
        format(&self)
    }
}

impl<T> Record<T> {
    /// Lists the files that are missing or altered.
    fn altered_files(&self, path: &Path) -> Vec<PathBuf> {
        let paths = (self.files.iter()).map(|(name, hash)| (path.with_file_name(name), hash));
        paths
            .filter(|(path, hash)| !hash_file(path).is_ok_and(|file_hash| file_hash == **hash))
            .map(|(path, _)| path)
            .collect()
    }
}

/// Hashes inputs as JSON, which has the names of all fields, and numbers that read back equal.
pub fn hash_inputs<T: Serialize>(inputs: &T) -> String {
    hex(&serde_json::to_vec(inputs).expect("inputs are plain data"))
}

/// File of this code, if it is not the running program: a module of another program.
static PROGRAM_FILE: OnceLock<PathBuf> = OnceLock::new();

/// Names the file that [`hash_program`] hashes in place of the running program; the first name
/// counts.
pub fn name_program(path: PathBuf) {
    let _ = PROGRAM_FILE.set(path);
}

/// Hashes the running program. Its bytes change with sources, dependencies, compiler and options:
/// everything that may change a number and is no other input. None if the bytes cannot be read.
pub fn hash_program() -> Option<String> {
    let named = PROGRAM_FILE.get().cloned();
    hash_file(&named.or_else(|| std::env::current_exe().ok())?).ok()
}

/// Hashes a regular file piece by piece: the program, which every run hashes, has a hundred
/// megabytes with debug information.
fn hash_file(path: &Path) -> Result<String, FileError> {
    let (file, _) = open_regular(path, MAX_TAKEN_BYTES)?;
    let mut hasher = blake3::Hasher::new();
    (hasher.update_reader(file)).map_err(|source| FileError::io(path, "read", source))?;
    Ok(hasher.finalize().to_hex().to_string())
}

fn hex(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_with_one_changed_byte_is_no_record() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("case.json");
        let made = vec![0.125, 3.0];
        put(&path, "these".to_owned(), &[], &made).unwrap();
        assert_eq!(look_up(&path, "these"), Some(made));
        let whole = std::fs::read(&path).unwrap();
        for at in 0..whole.len() {
            for bit in 0..8 {
                let mut altered = whole.clone();
                altered[at] ^= 1 << bit;
                std::fs::write(&path, altered).unwrap();
                let read = look_up::<Vec<f64>>(&path, "these");
                assert_eq!(read, None, "bit {bit} of byte {at}");
            }
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_record_that_is_a_pipe_or_a_device_is_no_record() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let pipe = std::process::Command::new("mkfifo")
            .arg(path("case.json"))
            .status();
        assert!(pipe.unwrap().success());
        std::os::unix::fs::symlink("/dev/zero", path("frame.json")).unwrap();
        for name in ["case.json", "frame.json"] {
            assert_eq!(look_up::<()>(&path(name), "these"), None, "{name}");
            // Nor are they hashed as a record's files.
            let files = [name.to_owned()];
            assert!(put(&path("other.json"), String::new(), &files, &()).is_err());
        }
    }

    #[test]
    fn a_record_that_that_names_a_file_elsewhere_is_no_record_and_removes_nothing() {
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
                hash: String::new(),
                inputs: "these".to_owned(),
                files: BTreeMap::from([(name.to_owned(), "0".repeat(64))]),
                made: (),
            };
            std::fs::write(&record, forged.text()).unwrap();
            remove_altered_files(&record, "these");
            assert!(elsewhere.exists(), "{name}");
            assert_eq!(look_up::<()>(&record, "these"), None, "{name}");
        }
    }
}
