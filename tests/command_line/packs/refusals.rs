//! Runs that cannot be packed, and archives that are not packs.

use std::fs;

use store::Manifest;
use tar::EntryType;
use tests::text::Parts;

use super::*;
use crate::sandbox::{Sandbox, assert_refused, make_fifo, quick_command, split};

#[track_caller]
fn refuse_to_pack(sandbox: &Sandbox, words: &str, parts: &(impl Parts + ?Sized)) {
    sandbox.refuse(&format!("truths pack {words} --out none.tar.zst"), parts);
    assert!(!sandbox.path("none.tar.zst").exists());
}

#[test]
fn what_is_no_finished_run_is_not_packed() {
    let sandbox = packed();
    fs::create_dir(sandbox.path("empty")).unwrap();
    let parts = "empty/run.json | there is no such file";
    refuse_to_pack(&sandbox, "empty", parts);
    let parts = "--scenes: no \"plat\" there | did you mean plate?";
    refuse_to_pack(&sandbox, "--scenes plat", parts);
    let replicate = "truth_trailing/replicate_007.exr";
    let rung = "ladder_trailing/n64.exr";
    for file in ["frame.exr", "truth_trailing.exr", replicate, rung] {
        let path = sandbox.path("out/plate").join(file);
        let bytes = fs::read(&path).unwrap();
        fs::remove_file(&path).unwrap();
        refuse_to_pack(&sandbox, "", &[file, "there is no such file", "unfinished"]);
        fs::write(&path, &bytes[..40]).unwrap();
        refuse_to_pack(&sandbox, "", &[file, "not a complete file"]);
        fs::write(&path, &bytes).unwrap();
    }
    // A ladder of another truth, and another truth than the run's.
    let rung = "plate/ladder_trailing/n8.exr";
    let path = sandbox.path("out").join(rung);
    let (own, other) = (fs::read(&path).unwrap(), with_other_seed());
    fs::copy(other.path("other").join(rung), &path).unwrap();
    refuse_to_pack(&sandbox, "", &[rung, "its header has the hash"]);
    fs::write(&path, own).unwrap();
    let render = "truths render --quiet --scenes plate --size 64x32 --samples-per-pixel 16";
    sandbox.done(&format!("{render} --seed 2 --out out"));
    let parts = ["plate/truth_trailing.exr", "the run was measured with"];
    refuse_to_pack(&sandbox, "", &parts);
}

/// Measures the plate with another seed into the folder `other`.
fn with_other_seed() -> Sandbox {
    let sandbox = Sandbox::new();
    run(&sandbox, "--filter identity --seed 2 --out other");
    sandbox
}

/// An unpacked pack.
struct Pack {
    sandbox: Sandbox,
    entries: Vec<Packed>,
}

impl Pack {
    fn new() -> Self {
        let sandbox = packed();
        let entries = entries(&sandbox.path("truths.tar.zst"));
        Self { sandbox, entries }
    }

    /// Checks that `verify` and a run refuse the archive `forged.tar.zst`, and that the run leaves nothing of it.
    #[track_caller]
    fn refused(&self, parts: &[&str]) {
        refuse_forged(&self.sandbox, 2, &[&["forged.tar.zst"], parts].concat());
    }

    /// Changes the entries, and expects that the archive is refused.
    #[track_caller]
    fn refuse_entries(&self, change: impl FnOnce(&mut Vec<Packed>), parts: &[&str]) {
        let mut entries = self.entries.clone();
        change(&mut entries);
        write(&self.sandbox.path("forged.tar.zst"), &entries);
        self.refused(parts);
    }

    /// Changes only the manifest.
    #[track_caller]
    fn refuse_manifest(&self, change: impl FnOnce(&mut Manifest), part: &str) {
        let change = |entries: &mut Vec<Packed>| change_manifest(entries, change);
        self.refuse_entries(change, &[part]);
    }
}

#[test]
fn an_archive_that_differs_from_its_manifest_is_refused() {
    let parts = Pack::new();
    let [name, next] = [5, 6].map(|at| parts.entries[at].name.clone());
    let last = parts.entries.last().unwrap().clone();

    let bytes = [&name, "with other bytes than its manifest.json says"];
    parts.refuse_entries(|entries| entries[5].bytes[300] ^= 1, &bytes);
    let size = [&name, "bytes of", "and its manifest.json says"];
    parts.refuse_entries(|entries| entries[5].bytes.push(0), &size);
    parts.refuse_entries(|entries| entries[5].bytes.truncate(300), &size);
    let missing = format!("holds {next} where its manifest.json names {name}");
    parts.refuse_entries(|entries| drop(entries.remove(5)), &[&missing]);
    let missing = format!("ends before {}", last.name);
    parts.refuse_entries(|entries| drop(entries.pop()), &[&missing]);
    let twice = format!("holds {name} where its manifest.json names {next}");
    parts.refuse_entries(|entries| entries.insert(6, entries[5].clone()), &[&twice]);
    let more = format!("holds {}, which its manifest.json does not name", last.name);
    parts.refuse_entries(|entries| entries.push(last), &[&more]);
    let late = ["does not begin with manifest.json"];
    parts.refuse_entries(|entries| drop(entries.remove(0)), &late);
    parts.refuse_entries(|entries| entries.swap(0, 1), &late);
}

#[test]
fn links_and_names_that_leave_the_folder_are_refused() {
    let parts = Pack::new();
    let name = &parts.entries[5].name.clone();
    for (kind, found) in [
        (EntryType::Symlink, "as a link; allowed: regular files"),
        (EntryType::Link, "as a link; allowed: regular files"),
        (EntryType::Directory, "as no regular file"),
        (EntryType::Fifo, "as no regular file"),
    ] {
        parts.refuse_entries(|entries| entries[5].kind = kind, &[name, found]);
    }
    // An entry that gives the next one a long name.
    let long = Packed {
        name: "long".to_owned(),
        kind: EntryType::GNULongName,
        bytes: b"../plate/frame.exr\0".to_vec(),
    };
    let found = format!("holds long where its manifest.json names {name}");
    parts.refuse_entries(|entries| entries.insert(5, long), &[&found]);
    for outside in ["../frame.exr", "plate/../../frame.exr", "/tmp/frame.exr"] {
        let change = |entries: &mut Vec<Packed>| {
            outside.clone_into(&mut entries[1].name);
            change_manifest(entries, |all| outside.clone_into(&mut all.files[0].path));
        };
        let found = format!("manifest.json names \"{outside}\"");
        parts.refuse_entries(change, &[&found]);
    }
}

#[test]
fn manifests_that_promise_too_much_are_refused() {
    let parts = Pack::new();
    parts.refuse_manifest(|all| all.format = 2, "it has format 2; allowed: 1");
    parts.refuse_manifest(|all| all.files.clear(), "names no file");
    parts.refuse_manifest(|all| all.files.swap(2, 3), "allowed: the order of paths");
    parts.refuse_manifest(|all| all.files[3] = all.files[2].clone(), "twice");
    let most = "allowed: up to 4294967296";
    parts.refuse_manifest(|all| all.files[3].bytes = 1 << 40, most);
    let most = "allowed: 64 times as many";
    parts.refuse_manifest(|all| all.files[3].bytes = 1 << 31, most);
    let change = |entries: &mut Vec<Packed>| entries[0].bytes = b"{".to_vec();
    parts.refuse_entries(change, &["manifest.json is no manifest of a pack"]);
    // A folder and a file for each would take half a minute.
    let empty = |number: usize| store::PackedFile {
        path: format!("s{number:06}/frame.exr"),
        bytes: 0,
        blake3: blake3::hash(b"").to_hex().to_string(),
        content_hash: "0".repeat(64),
        scene: "s".to_owned(),
        width: 16,
        height: 16,
        samples_per_pixel: 16,
    };
    let change = |all: &mut Manifest| all.files = (0..50_000).map(empty).collect();
    let change = |entries: &mut Vec<Packed>| change_manifest(entries, change);
    let found = "names 50000 files in an archive of";
    parts.refuse_entries(change, &[found, "one for each 64 bytes"]);
}

#[test]
fn an_archive_that_was_cut_off_or_goes_on_is_refused() {
    let parts = Pack::new();
    let forged = parts.sandbox.path("forged.tar.zst");
    let bytes = fs::read(parts.sandbox.path("truths.tar.zst")).unwrap();
    let (half, most) = (&bytes[..bytes.len() / 2], &bytes[..bytes.len() - 1]);
    let (more, other) = ([&bytes[..], b"more"].concat(), vec![b'x'; bytes.len()]);
    for bytes in [half, most, &more, &[], &other] {
        fs::write(&forged, bytes).unwrap();
        parts.refused(&["cut off"]);
    }
    let mut whole = zstd::decode_all(&bytes[..]).unwrap();
    whole.extend([1; 512]);
    compress(&forged, &whole);
    parts.refused(&["continues after its last file"]);
    // A header that promises more data than there is.
    let mut header = tar::Header::from_byte_slice(&whole[..512]).clone();
    header.set_size(1 << 36);
    header.set_cksum();
    whole[..512].copy_from_slice(header.as_bytes());
    compress(&forged, &whole);
    parts.refused(&["manifest.json"]);
}

#[test]
fn a_file_whose_header_has_another_hash_than_the_manifest_is_refused() {
    let Pack { sandbox, entries } = &mut Pack::new();
    let other = with_other_seed();
    other.done("truths pack other --out other.tar.zst");
    let other = manifest(&super::entries(&other.path("other.tar.zst")));
    change_manifest(entries, |manifest| {
        for (file, other) in manifest.files.iter_mut().zip(other.files) {
            file.content_hash = other.content_hash;
        }
    });
    write(&sandbox.path("forged.tar.zst"), entries);
    let words = "run --filter identity --seed 2 --truths forged.tar.zst --out fresh";
    let found = ["has another content_hash than manifest.json says"];
    assert_refused(&quick(sandbox, words), 2, &found);
    assert!(!sandbox.path("fresh/plate").exists());
}

#[test]
fn a_check_refuses_a_pack_that_git_tracks() {
    let sandbox = packed();
    sandbox.write_bound(1.0);
    let check = || {
        let more = split("--filter identity --truths truths.tar.zst");
        sandbox.outside_ci(&[&quick_command("check", "16")[..], &more].concat())
    };
    sandbox.git("init -q");
    sandbox.git("add scenes");
    let beside = check().status.code();
    assert_eq!(beside, Some(0), "it lies beside tracked files");
    sandbox.git("add truths.tar.zst");
    let parts = ["truths.tar.zst is tracked by git", "--truths"];
    assert_refused(&check(), 2, &parts);
}

#[test]
fn truths_that_are_neither_a_folder_nor_a_file_are_refused() {
    let sandbox = Sandbox::new();
    make_fifo(&sandbox.path("pipe"));
    let output = quick(&sandbox, "run --filter identity --truths pipe --out fresh");
    let part = "--truths pipe: is neither a folder nor a regular file";
    assert_refused(&output, 2, &[part]);
}
