//! Packs of truths: archives from other people.

use std::fs;
use std::path::Path;

use serde_json::Value;
use store::Pack;

use crate::place::Place;

/// Contents of a pack's files. No pack is read as pictures here.
const CONTENTS: [&[u8]; 3] = [b"a frame", b"a truth", b"a replicate"];

/// Unpacks an archive with this manifest and files with the names in it, whatever these are.
pub fn manifest(place: &mut Place, input: &[u8]) -> Option<()> {
    unpack(place, &pack_up(input))
}

/// Compresses an archive, reads it, and unpacks it like a run. Panics if that writes anything outside the folder.
pub fn unpack(place: &mut Place, archive: &[u8]) -> Option<()> {
    let path = place.write("pack.tar.zst", zstd::encode_all(archive, 1).unwrap());
    let folder = place.folder.join("out");
    fs::create_dir_all(&folder).unwrap();
    let read = Pack::open(&path).and_then(|pack| {
        pack.check()?;
        pack.unpack(&folder, |_| true)
    });
    fs::remove_dir_all(folder).unwrap();
    assert_eq!(list(&place.folder), ["pack.tar.zst"]);
    assert_eq!(list(place.folder.parent().unwrap()), ["canary.txt", "case"]);
    read.ok().map(drop)
}

/// Lists the names in a folder, sorted.
fn list(folder: &Path) -> Vec<String> {
    let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|entry| name(entry.unwrap())).collect();
    names.sort();
    names
}

/// Makes the archive of a manifest. A file whose hash fits one of the contents gets that content.
fn pack_up(manifest: &[u8]) -> Vec<u8> {
    let mut archive = tar::Builder::new(Vec::new());
    add(&mut archive, "manifest.json", manifest);
    let parsed: Value = serde_json::from_slice(manifest).unwrap_or_default();
    for file in parsed["files"].as_array().into_iter().flatten() {
        let hash = file["blake3"].as_str().unwrap_or_default();
        let fitting = (CONTENTS.iter()).find(|content| *blake3::hash(content).to_hex() == *hash);
        let name = file["path"].as_str().unwrap_or_default();
        add(&mut archive, name, fitting.copied().unwrap_or_default());
    }
    archive.into_inner().unwrap()
}

/// Adds a file under a name that may be forbidden; cuts off longer names.
fn add(archive: &mut tar::Builder<Vec<u8>>, name: &str, content: &[u8]) {
    let mut header = tar::Header::new_ustar();
    let field = &mut header.as_ustar_mut().unwrap().name;
    let length = name.len().min(field.len());
    field[..length].copy_from_slice(&name.as_bytes()[..length]);
    header.set_entry_type(tar::EntryType::Regular);
    header.set_size(content.len() as u64);
    header.set_mode(0o644);
    header.set_cksum();
    archive.append(&header, content).unwrap();
}
