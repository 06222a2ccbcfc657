//! Writing of packs.

use std::io::Write;
use std::ops::ControlFlow;
use std::path::Path;

use frame::{FileError, read_bounded, remove_leftovers, write_streamed};
use tar::{Builder, EntryType, Header};
use tracer::{Progress, TraceError, Watch};

use super::manifest::{MANIFEST, MAX_MANIFEST_BYTES, Manifest, PACK_FORMAT, PackedFile};
use crate::Error;
use crate::gather::MAX_TAKEN_BYTES;

/// Level of zstd. Rendered files are compressed already, and higher levels gain nothing.
const LEVEL: i32 = 3;
/// Permissions of a packed file: everybody may read it.
const MODE: u32 = 0o644;

/// Writes files below `folder` into the archive `pack`, and fills in their sizes and byte hashes. The same files give the same
/// bytes. `program` is the name and version that the manifest records.
///
/// # Errors
/// A file cannot be read or written, or changes meanwhile; or `watch` ends the work.
pub fn write_archive(
    mut files: Vec<PackedFile>,
    folder: &Path,
    pack: &Path,
    program: &str,
    watch: Watch,
) -> Result<Manifest, Error> {
    // A killed process may have left a part of a pack.
    let beside = pack.parent().filter(|parent| **parent != *"");
    remove_leftovers(beside.unwrap_or(Path::new(".")));
    let total = 2 * files.len() as u64;
    let advance = |done: usize| match watch(Progress {
        done: done as u64,
        total,
    }) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(TraceError::Cancelled),
    };
    for (index, file) in files.iter_mut().enumerate() {
        advance(index)?;
        let bytes = read_bounded(&folder.join(&file.path), MAX_TAKEN_BYTES)?;
        file.bytes = bytes.len() as u64;
        file.blake3 = blake3::hash(&bytes).to_hex().to_string();
    }
    let manifest = Manifest {
        format: PACK_FORMAT,
        program: program.to_owned(),
        files,
    };
    let hashed = manifest.files.len();
    write_streamed(pack, |file| {
        write_entries(&manifest, folder, file, pack, |index| {
            advance(hashed + index)
        })
    })?;
    Ok(manifest)
}

fn write_entries(
    manifest: &Manifest,
    folder: &Path,
    file: &mut dyn Write,
    pack: &Path,
    advance: impl Fn(usize) -> Result<(), TraceError>,
) -> Result<(), Error> {
    let fail = |source| FileError::io(pack, "write", source);
    let mut text = serde_json::to_string_pretty(manifest).expect("a manifest is plain data");
    text.push('\n');
    if text.len() as u64 > MAX_MANIFEST_BYTES {
        return Err(Error::Refused(format!(
            "{}: its list of files takes {} bytes; allowed: {MAX_MANIFEST_BYTES}; pack fewer scenes",
            pack.display(),
            text.len()
        )));
    }
    let packed = zstd::Encoder::new(file, LEVEL).map_err(fail)?;
    let mut archive = Builder::new(packed);
    append(&mut archive, MANIFEST, text.as_bytes()).map_err(fail)?;
    for (index, own) in manifest.files.iter().enumerate() {
        advance(index)?;
        let bytes = read_unchanged(folder, own)?;
        append(&mut archive, &own.path, &bytes).map_err(fail)?;
    }
    (archive.into_inner().and_then(zstd::Encoder::finish)).map_err(fail)?;
    Ok(())
}

/// Reads a file again; refuses one that has changed since it was hashed.
fn read_unchanged(folder: &Path, file: &PackedFile) -> Result<Vec<u8>, Error> {
    let path = folder.join(&file.path);
    let bytes = read_bounded(&path, MAX_TAKEN_BYTES)?;
    match blake3::hash(&bytes).to_hex().as_str() == file.blake3 {
        true => Ok(bytes),
        false => Err(Error::Refused(format!(
            "{}: changed while it was packed; wait until nothing writes to this folder",
            path.display()
        ))),
    }
}

/// Appends a file with a header that does not say who packed it, or when.
fn append<W: Write>(archive: &mut Builder<W>, path: &str, bytes: &[u8]) -> std::io::Result<()> {
    let mut header = Header::new_ustar();
    header.set_entry_type(EntryType::Regular);
    // Fails for a path longer than the 255 bytes of such a header.
    header.set_path(path)?;
    header.set_size(bytes.len() as u64);
    header.set_mode(MODE);
    header.set_mtime(0);
    header.set_uid(0);
    header.set_gid(0);
    header.set_cksum();
    archive.append(&header, bytes)
}
