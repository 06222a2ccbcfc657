//! Packs of kept truths: made of a run, taken by another, refused where they are not what they say, and verified.

mod forgeries;
mod refusals;
mod round_trip;
mod verification;

use std::fs;
use std::io::Write;
use std::path::Path;

use frame::{Replicate, Truth};
use store::Manifest;

use crate::sandbox::{Sandbox, split};

/// Options that measure in next to no time.
const QUICK: &str = "--quiet --size 64x32 --samples-per-pixel 16 --jitter-frames 2";

/// Replicates of a truth.
const REPLICATES: u32 = 8;

/// Measures a plate into the folder `out`, with the filters.
fn run(sandbox: &Sandbox, filters: &str, more: &[&str]) {
    let words = [&["run", "--filter", filters], &split(QUICK)[..], more].concat();
    sandbox.execute(&words);
}

/// Makes a sandbox with a finished run of the identity in `out`, and its pack `truths.tar.zst`.
fn packed() -> Sandbox {
    let sandbox = Sandbox::new();
    run(&sandbox, "identity", &[]);
    sandbox.execute(&["truths", "pack"]);
    sandbox
}

/// An entry of an archive.
#[derive(Clone)]
struct Packed {
    name: String,
    kind: tar::EntryType,
    bytes: Vec<u8>,
}

/// Reads all entries of a pack.
fn entries(pack: &Path) -> Vec<Packed> {
    let bytes = zstd::decode_all(fs::File::open(pack).unwrap()).unwrap();
    let mut archive = tar::Archive::new(&bytes[..]);
    let entries = archive.entries().unwrap().map(Result::unwrap);
    entries
        .map(|mut entry| {
            let mut bytes = Vec::new();
            std::io::Read::read_to_end(&mut entry, &mut bytes).unwrap();
            Packed {
                name: String::from_utf8(entry.path_bytes().into_owned()).unwrap(),
                kind: entry.header().entry_type(),
                bytes,
            }
        })
        .collect()
}

/// Writes an archive of any entries, whether they may stand in a pack or not.
fn write(pack: &Path, entries: &[Packed]) {
    let mut archive = tar::Builder::new(Vec::new());
    for entry in entries {
        let mut header = tar::Header::new_ustar();
        // `set_path` refuses what is tried here.
        header.as_old_mut().name[..entry.name.len()].copy_from_slice(entry.name.as_bytes());
        header.set_entry_type(entry.kind);
        header.set_size(entry.bytes.len() as u64);
        header.set_cksum();
        archive.append(&header, &entry.bytes[..]).unwrap();
    }
    compress(pack, &archive.into_inner().unwrap());
}

/// Changes the manifest of a pack that was taken apart.
fn change_manifest(entries: &mut [Packed], change: impl FnOnce(&mut Manifest)) {
    let mut manifest: Manifest = serde_json::from_slice(&entries[0].bytes).unwrap();
    change(&mut manifest);
    entries[0].bytes = serde_json::to_vec(&manifest).unwrap();
}

fn compress(pack: &Path, bytes: &[u8]) {
    let mut encoder = zstd::Encoder::new(fs::File::create(pack).unwrap(), 1).unwrap();
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap();
}

/// Changes the lowest bit of one number of a replicate, and makes the truth anew, as a forger would who knows the program.
fn forge(sandbox: &Sandbox, out: &str, file: &str, pixel: usize) {
    let path = sandbox.path(file);
    let mut replicate = Replicate::read(&path).unwrap();
    let red = &mut replicate.picture.color.pixels[pixel][0];
    *red = f32::from_bits(red.to_bits() ^ 1);
    replicate.write(&path).unwrap();
    renew_truth(sandbox, out);
}

/// Makes the truth of the replicates that lie beside it.
fn renew_truth(sandbox: &Sandbox, out: &str) {
    let folder = sandbox.path(out).join("plate");
    let replicates: Vec<Replicate> = replicate_files()
        .map(|file| Replicate::read(&folder.join(file)).unwrap())
        .collect();
    let truth = Truth::of(&replicates).unwrap();
    truth.write(&folder.join("truth_trailing.exr")).unwrap();
}

/// Lists the files of the truth's replicates in the folder of their scene.
fn replicate_files() -> impl Iterator<Item = String> + Clone {
    (0..REPLICATES).map(|index| format!("truth_trailing/replicate_{index:03}.exr"))
}
