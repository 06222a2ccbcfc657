//! Packs of truths: archives that come from other people.

use std::fs;
use std::path::Path;

use serde_json::Value;
use store::{Manifest, PACK_FORMAT, Pack, PackedFile};

use crate::place::Place;
use crate::seeds::Seed;
use crate::target::{Shape, Target};
use crate::{huge, tokens};

/// Where the files of a pack lie.
const PATHS: [&str; 3] = [
    "plate/frame.exr",
    "plate/truth_centred.exr",
    "plate/truth_centred/replicate_000.exr",
];
/// Paths that would leave the folder. Each stands in place of the first one.
const OUTSIDE: [&str; 3] = ["../outside.exr", "../../outside.exr", "a/../../outside.exr"];
/// What the files of a pack hold. No pack is read as pictures here.
const CONTENTS: [&[u8]; 3] = [b"a frame", b"a truth", b"a replicate"];

/// The manifest of a pack. The files in its archive have the names that the manifest gives them, whatever these are.
pub static MANIFEST: Target = Target {
    name: "pack_manifest",
    share: 450,
    batch: 250,
    shape: Shape::Text,
    tokens: tokens::JSON,
    seeds: |_| {
        let mut seeds = vec![
            Seed::Bytes(manifest(&PATHS)),
            Seed::Made(huge::deep_json),
            Seed::Made(empty_files),
        ];
        let outside = OUTSIDE.map(|path| Seed::Bytes(manifest(&[path, PATHS[1], PATHS[2]])));
        seeds.extend(outside);
        seeds
    },
    run: |place, input| unpack(place, &pack_up(input)),
};

/// The archive of a pack, before it is compressed.
pub static ARCHIVE: Target = Target {
    name: "pack_archive",
    share: 450,
    batch: 250,
    shape: Shape::Bytes,
    tokens: &["ustar", "../../canary.txt", "/dev/null", "5", "2"],
    seeds: |_| vec![Seed::Bytes(pack_up(&manifest(&PATHS)))],
    run: unpack,
};

/// Compresses an archive, reads it, and unpacks it as a run does. Panics if anything lies outside of the folder then.
fn unpack(place: &mut Place, archive: &[u8]) {
    let path = place.write("pack.tar.zst", zstd::encode_all(archive, 1).unwrap());
    let folder = place.folder.join("out");
    fs::create_dir_all(&folder).unwrap();
    if let Ok(pack) = Pack::open(&path)
        && pack.check().is_ok()
    {
        drop(pack.unpack(&folder, |_| true));
    }
    fs::remove_dir_all(folder).unwrap();
    assert_eq!(list(&place.folder), ["pack.tar.zst"]);
    assert_eq!(list(place.folder.parent().unwrap()), ["canary.txt", "case"]);
}

/// Lists the names in a folder, sorted.
fn list(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// Makes a manifest of more files than a run has, all of them empty.
fn empty_files() -> Vec<u8> {
    let paths: Vec<String> = (0..100_000)
        .map(|at| format!("s{at:06}/frame.exr"))
        .collect();
    let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
    manifest(&paths)
}

/// Makes a manifest of files at these paths; those without a content of their own are empty.
fn manifest(paths: &[&str]) -> Vec<u8> {
    let contents = CONTENTS.into_iter().chain(std::iter::repeat(&b""[..]));
    let files = (paths.iter().zip(contents))
        .map(|(path, content)| PackedFile {
            path: (*path).to_owned(),
            bytes: content.len() as u64,
            blake3: blake3::hash(content).to_hex().to_string(),
            content_hash: "0".repeat(64),
            scene: "plate".to_owned(),
            width: 16,
            height: 16,
            samples_per_pixel: 16,
        })
        .collect();
    let manifest = Manifest {
        format: PACK_FORMAT,
        program: "shuttertruth".to_owned(),
        files,
    };
    serde_json::to_vec_pretty(&manifest).unwrap()
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

/// Adds a file under a name that may be forbidden; longer names are cut off.
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
