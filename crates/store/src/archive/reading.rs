//! Reader of packs, which anybody may have written.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use frame::{FileError, write_atomically};
use tar::{Archive, Entry, EntryType};

use super::manifest::{MANIFEST, MAX_MANIFEST_BYTES, Manifest, PackedFile};
use crate::Error;

/// Upper limit on the zeros that end an archive, in bytes: a block of GNU tar.
const MAX_PADDING: u64 = 10_240;

type Unpacked = zstd::Decoder<'static, BufReader<File>>;

/// A pack with a manifest that was read and checked; its files were not.
#[derive(Clone, Debug)]
pub struct Pack {
    /// The archive.
    pub path: PathBuf,
    /// Its list of files.
    pub manifest: Manifest,
}

impl Pack {
    /// Reads the manifest of a pack.
    ///
    /// # Errors
    /// The file is no pack of this version.
    pub fn open(path: &Path) -> Result<Self, Error> {
        let size = std::fs::metadata(path).map_err(|source| FileError::io(path, "read", source))?;
        let mut archive = open_archive(path)?;
        let manifest = (list_entries(&mut archive))
            .and_then(|mut entries| read_manifest(&mut entries))
            .and_then(|bytes| Manifest::parse(&bytes, size.len()));
        Ok(Self {
            path: path.to_owned(),
            manifest: manifest.map_err(|reason| refuse(path, &reason))?,
        })
    }

    /// Reads all of the archive, and hands each file with its bytes to `visit`, in the order of the manifest.
    ///
    /// # Errors
    /// The archive does not match its manifest byte for byte, or `visit` fails.
    fn visit(
        &self,
        mut visit: impl FnMut(&PackedFile, &[u8]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let refuse = |reason: String| refuse(&self.path, &reason);
        let mut archive = open_archive(&self.path)?;
        {
            let mut entries = list_entries(&mut archive).map_err(refuse)?;
            read_manifest(&mut entries).map_err(refuse)?;
            for file in &self.manifest.files {
                visit(file, &read_entry(entries.next(), file).map_err(refuse)?)?;
            }
            if let Some(entry) = entries.next() {
                let entry = entry.map_err(|error| refuse(broken(error)))?;
                let name = name_of(&entry);
                return Err(refuse(format!(
                    "holds {name}, which its {MANIFEST} does not name"
                )));
            }
        }
        // Reading to the end finds an archive that was cut off after its last file.
        let mut rest = Vec::new();
        let padding = archive
            .into_inner()
            .take(MAX_PADDING + 1)
            .read_to_end(&mut rest);
        let padding = padding.map_err(|error| refuse(broken(error)))?;
        match padding as u64 <= MAX_PADDING && rest.iter().all(|byte| *byte == 0) {
            true => Ok(()),
            false => Err(refuse("continues after its last file".to_owned())),
        }
    }

    /// Reads all of the archive and compares it with the manifest; writes nothing.
    ///
    /// # Errors
    /// The archive does not match its manifest byte for byte.
    pub fn check(&self) -> Result<(), Error> {
        self.visit(|_, _| Ok(()))
    }

    /// Writes the files that `is_wanted` below a folder, replacing any there. Call [`Pack::check`] first, so that nothing is written
    /// from a broken archive.
    ///
    /// # Errors
    /// As [`Pack::check`], or a file cannot be written.
    pub fn unpack(
        &self,
        folder: &Path,
        is_wanted: impl Fn(&PackedFile) -> bool,
    ) -> Result<(), Error> {
        self.visit(|file, bytes| {
            if is_wanted(file) {
                write_atomically(&folder.join(&file.path), bytes)?;
            }
            Ok(())
        })
    }
}

fn open_archive(path: &Path) -> Result<Archive<Unpacked>, Error> {
    let io = |source| FileError::io(path, "read", source);
    // A device or a FIFO would block.
    if !std::fs::metadata(path).map_err(io)?.is_file() {
        return Err(refuse(path, "is no regular file"));
    }
    let file = File::open(path).map_err(io)?;
    Ok(Archive::new(zstd::Decoder::new(file).map_err(io)?))
}

/// An entry of an archive, or why it cannot be read.
type Found<'a> = std::io::Result<Entry<'a, Unpacked>>;

/// Lists the entries as they are, so that long names, which are entries of their own, are refused.
fn list_entries(
    archive: &mut Archive<Unpacked>,
) -> Result<impl Iterator<Item = Found<'_>>, String> {
    Ok(archive.entries().map_err(broken)?.raw(true))
}

fn read_manifest<'a>(entries: &mut impl Iterator<Item = Found<'a>>) -> Result<Vec<u8>, String> {
    let entry = entries.next().transpose().map_err(broken)?;
    let is_manifest = |entry: &Entry<Unpacked>| {
        entry.header().entry_type() == EntryType::Regular
            && *entry.path_bytes() == *MANIFEST.as_bytes()
    };
    let Some(mut entry) = entry.filter(is_manifest) else {
        return Err(format!("does not begin with {MANIFEST}"));
    };
    let bytes = read_at_most(&mut entry, MAX_MANIFEST_BYTES)?;
    match bytes.len() as u64 <= MAX_MANIFEST_BYTES {
        true => Ok(bytes),
        false => Err(format!(
            "has a {MANIFEST} of more than {MAX_MANIFEST_BYTES} bytes"
        )),
    }
}

/// Reads an entry that must be a file of the manifest.
fn read_entry(entry: Option<Found>, file: &PackedFile) -> Result<Vec<u8>, String> {
    let Some(entry) = entry else {
        return Err(format!("ends before {}", file.path));
    };
    let mut entry = entry.map_err(broken)?;
    let name = name_of(&entry);
    if *entry.path_bytes() != *file.path.as_bytes() {
        return Err(format!(
            "holds {name} where its {MANIFEST} names {}",
            file.path
        ));
    }
    let kind = entry.header().entry_type();
    if kind != EntryType::Regular {
        let kind = match kind.is_symlink() || kind.is_hard_link() {
            true => "a link",
            false => "no regular file",
        };
        return Err(format!("holds {name} as {kind}; allowed: regular files"));
    }
    let bytes = read_at_most(&mut entry, file.bytes)?;
    let found = bytes.len() as u64;
    if found != file.bytes || entry.size() != file.bytes {
        return Err(format!(
            "holds {} bytes of {name}, and its {MANIFEST} says {}",
            found.max(entry.size()),
            file.bytes
        ));
    }
    match blake3::hash(&bytes).to_hex().as_str() == file.blake3 {
        true => Ok(bytes),
        false => Err(format!(
            "holds {name} with other bytes than its {MANIFEST} says: their BLAKE3 hashes differ"
        )),
    }
}

/// Reads an entry up to one byte beyond a limit. Memory grows with the bytes read, not with a header's claim.
fn read_at_most(entry: &mut Entry<Unpacked>, limit: u64) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let read = entry.take(limit + 1).read_to_end(&mut bytes);
    read.map(|_| bytes).map_err(broken)
}

fn name_of(entry: &Entry<Unpacked>) -> String {
    String::from_utf8_lossy(&entry.path_bytes()).into_owned()
}

fn broken(error: std::io::Error) -> String {
    format!("cannot be unpacked, and may be cut off: {error}")
}

fn refuse(path: &Path, reason: &str) -> Error {
    Error::Refused(format!(
        "{}: {reason}; allowed: a pack as `shuttertruth truths pack` writes it; make or fetch it again",
        path.display()
    ))
}
