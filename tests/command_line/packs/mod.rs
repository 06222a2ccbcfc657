//! Packs of kept truths: made from a run, used by another, refused if they are false, and verified.

mod forgeries;
mod refusals;
mod round_trip;

use std::fs;
use std::io::{Read, Write};
use std::path::Path;
use std::process::Output;

use frame::{Replicate, Truth};
use store::Manifest;
use tests::text::Parts;

use crate::sandbox::{Sandbox, assert_refused, split};
use crate::shared_runs::QUICK;

/// Replicates of a truth.
const REPLICATES: u32 = 8;

/// Runs a line of words with the quick options.
fn quick(sandbox: &Sandbox, line: &str) -> Output {
    sandbox.shuttertruth(&split(&format!("{line} {QUICK}")))
}

/// Measures into the folder `out`, or another one.
fn run(sandbox: &Sandbox, line: &str) {
    sandbox.done(&format!("run {line} {QUICK}"));
}

/// Makes a sandbox with a finished run of the identity in `out`, and its pack `truths.tar.zst`.
fn packed() -> Sandbox {
    Sandbox::once(|sandbox| {
        run(sandbox, "--filter identity");
        sandbox.done("truths pack");
    })
}

/// Packs the run in `out` as `forged.tar.zst`.
fn pack_forged(sandbox: &Sandbox) {
    sandbox.done("truths pack --out forged.tar.zst");
}

/// Checks that `verify` refuses `forged.tar.zst` with this exit code, and that a run refuses it and leaves nothing of it.
#[track_caller]
fn refuse_forged(sandbox: &Sandbox, code: i32, parts: &(impl Parts + ?Sized)) {
    let verified = sandbox.shuttertruth(&split("truths verify forged.tar.zst"));
    assert_refused(&verified, code, parts);
    let line = "run --filter identity --truths forged.tar.zst --out fresh";
    let taken = quick(sandbox, line);
    assert_refused(&taken, 2, parts);
    assert!(!sandbox.path("fresh/plate").exists());
    assert!(!sandbox.path("fresh/.shuttertruth.unpacked").exists());
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
    let entries = archive.entries().unwrap().map(|entry| {
        let (mut entry, mut bytes) = (entry.unwrap(), Vec::new());
        entry.read_to_end(&mut bytes).unwrap();
        Packed {
            name: String::from_utf8(entry.path_bytes().into_owned()).unwrap(),
            kind: entry.header().entry_type(),
            bytes,
        }
    });
    entries.collect()
}

/// Writes an archive of any entries, allowed in a pack or not.
fn write(pack: &Path, entries: &[Packed]) {
    let mut archive = tar::Builder::new(Vec::new());
    for entry in entries {
        let mut header = tar::Header::new_ustar();
        // `set_path` would refuse these names.
        header.as_old_mut().name[..entry.name.len()].copy_from_slice(entry.name.as_bytes());
        header.set_entry_type(entry.kind);
        header.set_size(entry.bytes.len() as u64);
        header.set_cksum();
        archive.append(&header, &entry.bytes[..]).unwrap();
    }
    compress(pack, &archive.into_inner().unwrap());
}

fn compress(pack: &Path, bytes: &[u8]) {
    let mut encoder = zstd::Encoder::new(fs::File::create(pack).unwrap(), 1).unwrap();
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap();
}

/// Reads the manifest of an unpacked pack.
fn manifest(entries: &[Packed]) -> Manifest {
    serde_json::from_slice(&entries[0].bytes).unwrap()
}

/// Changes the manifest of an unpacked pack.
fn change_manifest(entries: &mut [Packed], change: impl FnOnce(&mut Manifest)) {
    let mut manifest = manifest(entries);
    change(&mut manifest);
    entries[0].bytes = serde_json::to_vec(&manifest).unwrap();
}

/// Changes a replicate, with a valid checksum.
fn change_replicate(path: &Path, change: impl FnOnce(&mut Replicate)) {
    let mut replicate = Replicate::read(path).unwrap();
    change(&mut replicate);
    replicate.write(path).unwrap();
}

/// Makes the truth from the replicates next to it, like a forger who knows the program.
fn renew_truth(sandbox: &Sandbox) {
    let folder = sandbox.path("out/plate");
    let replicates: Vec<Replicate> = replicate_files()
        .map(|file| Replicate::read(&folder.join(file)).unwrap())
        .collect();
    let truth = Truth::of(&replicates).unwrap();
    truth.write(&folder.join("truth_trailing.exr")).unwrap();
}

/// Names a replicate in the folder of its scene.
fn replicate_file(index: u32) -> String {
    format!("truth_trailing/replicate_{index:03}.exr")
}

/// Lists the files of the truth's replicates in its scene's folder.
fn replicate_files() -> impl Iterator<Item = String> + Clone {
    (0..REPLICATES).map(replicate_file)
}
