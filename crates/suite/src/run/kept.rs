//! What was made before, beside the inputs that it was made of: read back where those are the same still, and nothing has
//! touched the files since.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::path::{Component, Path, PathBuf};

use frame::{FileError, write_atomically};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// A piece of work, as it is kept.
#[derive(Serialize, Deserialize)]
struct Kept<T> {
    /// Hash of all that determines it.
    inputs: String,
    /// The files that belong to it, by their names beside this one, each with the hash of its bytes.
    files: BTreeMap<String, String>,
    /// What was found.
    made: T,
    /// Hash of all of the above: what was altered is not taken for what was found.
    seal: String,
}

/// Keeps what was `made` of such inputs at `record`, after the `files` beside it have been written.
pub(crate) fn keep<T: Serialize>(
    record: &Path,
    inputs: String,
    files: &[String],
    made: &T,
) -> Result<(), FileError> {
    let files: BTreeMap<String, String> = (files.iter())
        .map(|name| Ok((name.clone(), hash_of_file(&record.with_file_name(name))?)))
        .collect::<std::io::Result<_>>()
        .map_err(|source| FileError::io(record, "read what belongs to", source))?;
    let kept = Kept {
        seal: seal(&inputs, &files, made),
        inputs,
        files,
        made,
    };
    let text = serde_json::to_string_pretty(&kept).expect("what is kept is plain data") + "\n";
    write_atomically(record, text.as_bytes())
}

/// What was made of such inputs. None where there is no such thing, where the record is broken, or where any of its files is
/// missing or not as it was written: then it has to be made anew, as truths are.
pub(crate) fn recall<T: Serialize + DeserializeOwned>(record: &Path, inputs: &str) -> Option<T> {
    let kept = read::<T>(record, inputs)?;
    kept.altered(record).is_empty().then_some(kept.made)
}

/// What was made of such inputs, whether or not its files are still there.
pub(crate) fn read_record<T: Serialize + DeserializeOwned>(
    record: &Path,
    inputs: &str,
) -> Option<T> {
    read::<T>(record, inputs).map(|kept| kept.made)
}

/// Removes the files of such inputs that are not as they were written: what a file says of itself may have outlived its
/// content.
pub(crate) fn discard_altered(record: &Path, inputs: &str) {
    for path in read::<()>(record, inputs)
        .iter()
        .flat_map(|kept| kept.altered(record))
    {
        // One that is missing is as good as removed.
        let _ = std::fs::remove_file(path);
    }
}

/// A whole record of such inputs. One that names a file outside its own folder is none: nothing out there is read or removed.
fn read<T: Serialize + DeserializeOwned>(record: &Path, inputs: &str) -> Option<Kept<T>> {
    let kept: Kept<T> = serde_json::from_slice(&std::fs::read(record).ok()?).ok()?;
    let is_whole =
        kept.inputs == inputs && kept.seal == seal(&kept.inputs, &kept.files, &kept.made);
    (is_whole && kept.files.keys().all(|name| is_plain(name))).then_some(kept)
}

/// Whether a name is that of a file in the same folder, and no path.
fn is_plain(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    let first = parts.next();
    matches!(first, Some(Component::Normal(part)) if part == name) && parts.next().is_none()
}

impl<T> Kept<T> {
    /// Its files that are missing, or not as they were written.
    fn altered(&self, record: &Path) -> Vec<PathBuf> {
        let paths = (self.files.iter()).map(|(name, hash)| (record.with_file_name(name), hash));
        paths
            .filter(|(path, hash)| !hash_of_file(path).is_ok_and(|found| found == **hash))
            .map(|(path, _)| path)
            .collect()
    }
}

/// One hash of all inputs. Debug output holds every field, and numbers so that they read back equal: a new field cannot be
/// forgotten.
pub(crate) fn hash_of(inputs: &dyn Debug) -> String {
    hex(format!("{inputs:?}").as_bytes())
}

/// Hash of the running program: whatever may change a number and is no other input, sources, dependencies, compiler and its
/// options, changes these bytes. None where they cannot be read, and nothing can be kept.
pub(crate) fn hash_of_program() -> Option<String> {
    hash_of_file(&std::env::current_exe().ok()?).ok()
}

fn seal<T: Serialize>(inputs: &str, files: &BTreeMap<String, String>, made: &T) -> String {
    hex(&serde_json::to_vec(&(inputs, files, made)).expect("what is kept is plain data"))
}

fn hash_of_file(path: &Path) -> std::io::Result<String> {
    Ok(hex(&std::fs::read(path)?))
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
        for name in [
            "../mine.txt",
            elsewhere.to_str().unwrap(),
            "a/../../mine.txt",
            "..",
            "",
        ] {
            // Sealed as a record of the program's own would be.
            let files = BTreeMap::from([(name.to_owned(), "0".repeat(64))]);
            let inputs = "these".to_owned();
            let (seal, made) = (seal(&inputs, &files, &()), ());
            let kept = Kept {
                inputs,
                files,
                made,
                seal,
            };
            std::fs::write(&record, serde_json::to_vec(&kept).unwrap()).unwrap();
            discard_altered(&record, "these");
            assert!(elsewhere.exists(), "{name}");
            assert_eq!(recall::<()>(&record, "these"), None, "{name}");
        }
    }

    #[test]
    fn what_was_kept_is_recalled_until_anything_about_it_changes() {
        let folder = tempfile::tempdir().unwrap();
        let (record, picture) = (folder.path().join("case.json"), folder.path().join("a.png"));
        let recalled = || recall::<f64>(&record, "these");
        assert_eq!(recalled(), None, "nothing is there yet");
        std::fs::write(&picture, "picture").unwrap();
        let files = ["a.png".to_owned()];
        keep(&record, "these".to_owned(), &files, &0.1).unwrap();
        assert_eq!(recalled(), Some(0.1));
        assert_eq!(recall::<f64>(&record, "others"), None);

        std::fs::write(&picture, "picturE").unwrap();
        assert_eq!(recalled(), None, "a picture was altered");
        std::fs::remove_file(&picture).unwrap();
        assert_eq!(recalled(), None, "a picture is missing");
        std::fs::write(&picture, "picture").unwrap();
        assert_eq!(recalled(), Some(0.1));

        let text = std::fs::read_to_string(&record).unwrap();
        std::fs::write(&record, text.replace("0.1", "0.2")).unwrap();
        assert_eq!(recalled(), None, "the score was altered");
        std::fs::write(&record, &text[..text.len() / 2]).unwrap();
        assert_eq!(recalled(), None, "the record was cut short");
    }
}
