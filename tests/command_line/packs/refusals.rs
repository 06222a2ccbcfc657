//! Runs that cannot be packed, and archives that are no packs.

use std::fs;
use std::process::Command;

use store::Manifest;
use tar::EntryType;

use super::{Packed, QUICK, change_manifest, compress, entries, packed, run, write};
use crate::sandbox::{Sandbox, assert_refused, make_fifo, quick_command, split};

#[track_caller]
fn refuse_to_pack(sandbox: &Sandbox, words: &[&str], parts: &[&str]) {
    let all = [&["truths", "pack"], words, &["--out", "none.tar.zst"]].concat();
    assert_refused(&sandbox.shuttertruth(&all), 2, parts);
    assert!(!sandbox.path("none.tar.zst").exists());
}

#[test]
fn what_is_no_finished_run_is_not_packed() {
    let sandbox = packed();
    fs::create_dir(sandbox.path("empty")).unwrap();
    refuse_to_pack(
        &sandbox,
        &["empty"],
        &["empty/run.json", "there is no such file"],
    );
    refuse_to_pack(
        &sandbox,
        &["--scenes", "plat"],
        &["--scenes: no \"plat\" there", "did you mean plate?"],
    );
    for file in [
        "frame.exr",
        "truth_trailing.exr",
        "truth_trailing/replicate_007.exr",
        "ladder_trailing/n64.exr",
    ] {
        let path = sandbox.path("out/plate").join(file);
        let bytes = fs::read(&path).unwrap();
        fs::remove_file(&path).unwrap();
        refuse_to_pack(
            &sandbox,
            &[],
            &[file, "there is no such file", "unfinished"],
        );
        fs::write(&path, &bytes[..40]).unwrap();
        refuse_to_pack(&sandbox, &[], &[file, "not a complete file"]);
        fs::write(&path, &bytes).unwrap();
    }
    // Another truth in the folder than the run was measured with.
    let render = "truths render --quiet --scenes plate --size 64x32 --samples-per-pixel 16 --seed 2 --out out";
    sandbox.execute(&split(render));
    let parts = ["plate/truth_trailing.exr", "the run was measured with"];
    refuse_to_pack(&sandbox, &[], &parts);
}

#[test]
fn a_ladder_of_another_truth_is_not_packed() {
    let sandbox = packed();
    run(&sandbox, "identity", &["--seed", "2", "--out", "other"]);
    let rung = "plate/ladder_trailing/n8.exr";
    fs::copy(
        sandbox.path("other").join(rung),
        sandbox.path("out").join(rung),
    )
    .unwrap();
    refuse_to_pack(&sandbox, &[], &[rung, "its header has the hash"]);
}

/// A pack, taken apart.
struct Parts {
    sandbox: Sandbox,
    entries: Vec<Packed>,
}

impl Parts {
    fn new() -> Self {
        let sandbox = packed();
        let entries = entries(&sandbox.path("truths.tar.zst"));
        Self { sandbox, entries }
    }

    /// Refuses the archive `forged.tar.zst`, in `verify` and in a run, which leaves nothing of it.
    #[track_caller]
    fn refused(&self, parts: &[&str]) {
        let parts = [&["forged.tar.zst"], parts].concat();
        let verify = ["truths", "verify", "forged.tar.zst"];
        assert_refused(&self.sandbox.shuttertruth(&verify), 2, &parts);
        let words = "run --filter identity --truths forged.tar.zst --out fresh";
        let output = (self.sandbox).shuttertruth(&[&split(words)[..], &split(QUICK)].concat());
        assert_refused(&output, 2, &parts);
        assert!(!self.sandbox.path("fresh/plate").exists());
        assert!(!self.sandbox.path("fresh/.shuttertruth.unpacked").exists());
    }

    /// Changes the entries, and expects that the archive is refused.
    #[track_caller]
    fn refuse_entries(&self, change: impl FnOnce(&mut Vec<Packed>), parts: &[&str]) {
        let mut entries = self.entries.clone();
        change(&mut entries);
        write(&self.sandbox.path("forged.tar.zst"), &entries);
        self.refused(parts);
    }

    /// Changes the manifest alone.
    #[track_caller]
    fn refuse_manifest(&self, change: impl FnOnce(&mut Manifest), parts: &[&str]) {
        let change = |entries: &mut Vec<Packed>| change_manifest(entries, change);
        self.refuse_entries(change, parts);
    }

    /// Changes the bytes of the archive.
    #[track_caller]
    fn refuse_bytes(&self, change: impl FnOnce(&mut Vec<u8>), parts: &[&str]) {
        let mut bytes = fs::read(self.sandbox.path("truths.tar.zst")).unwrap();
        change(&mut bytes);
        fs::write(self.sandbox.path("forged.tar.zst"), bytes).unwrap();
        self.refused(parts);
    }
}

#[test]
fn an_archive_that_differs_from_its_manifest_is_refused() {
    let parts = Parts::new();
    let name = &parts.entries[5].name.clone();
    let next = &parts.entries[6].name.clone();
    let last = &parts.entries.last().unwrap().name.clone();

    parts.refuse_entries(
        |entries| entries[5].bytes[300] ^= 1,
        &[name, "with other bytes than its manifest.json says"],
    );
    parts.refuse_entries(
        |entries| entries[5].bytes.push(0),
        &[name, "bytes of", "and its manifest.json says"],
    );
    parts.refuse_entries(
        |entries| entries[5].bytes.truncate(300),
        &[name, "bytes of", "and its manifest.json says"],
    );
    let missing = format!("holds {next} where its manifest.json names {name}");
    parts.refuse_entries(|entries| drop(entries.remove(5)), &[&missing]);
    let missing = format!("ends before {last}");
    parts.refuse_entries(|entries| drop(entries.pop()), &[&missing]);
    let twice = format!("holds {name} where its manifest.json names {next}");
    parts.refuse_entries(|entries| entries.insert(6, entries[5].clone()), &[&twice]);
    let more = format!("holds {last}, which its manifest.json does not name");
    parts.refuse_entries(
        |entries| entries.push(entries.last().unwrap().clone()),
        &[&more],
    );
    let late = ["does not begin with manifest.json"];
    parts.refuse_entries(|entries| drop(entries.remove(0)), &late);
    parts.refuse_entries(|entries| entries.swap(0, 1), &late);
}

#[test]
fn links_and_names_that_leave_the_folder_are_refused() {
    let parts = Parts::new();
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
            change_manifest(entries, |manifest| {
                outside.clone_into(&mut manifest.files[0].path);
            });
        };
        let found = format!("manifest.json names \"{outside}\"");
        parts.refuse_entries(change, &[&found]);
    }
}

#[test]
fn manifests_that_promise_too_much_are_refused() {
    let parts = Parts::new();
    parts.refuse_manifest(
        |manifest| manifest.format = 2,
        &["it has format 2; allowed: 1"],
    );
    parts.refuse_manifest(|manifest| manifest.files.clear(), &["names no file"]);
    parts.refuse_manifest(
        |manifest| manifest.files.swap(2, 3),
        &["allowed: the order of paths"],
    );
    parts.refuse_manifest(
        |manifest| manifest.files[3] = manifest.files[2].clone(),
        &["twice"],
    );
    let file = |number: usize, bytes: u64| store::PackedFile {
        path: format!("s{number:06}/frame.exr"),
        bytes,
        blake3: blake3::hash(b"").to_hex().to_string(),
        content_hash: "0".repeat(64),
        scene: "s".to_owned(),
        width: 16,
        height: 16,
        samples_per_pixel: 16,
    };
    // A folder and a file for each would take half a minute.
    parts.refuse_manifest(
        |manifest| manifest.files = (0..200_000).map(|number| file(number, 0)).collect(),
        &[
            "names 200000 files in an archive of",
            "one for each 64 bytes",
        ],
    );
    parts.refuse_manifest(
        |manifest| manifest.files[3].bytes = 1 << 40,
        &["allowed: up to 4294967296"],
    );
    parts.refuse_manifest(
        |manifest| manifest.files[3].bytes = 1 << 31,
        &["in an archive of", "allowed: 64 times as many"],
    );
    let change = |entries: &mut Vec<Packed>| entries[0].bytes = b"{".to_vec();
    parts.refuse_entries(change, &["manifest.json is no manifest of a pack"]);
}

#[test]
fn an_archive_that_was_cut_off_or_goes_on_is_refused() {
    let parts = Parts::new();
    let cut = ["cut off"];
    parts.refuse_bytes(|bytes| bytes.truncate(bytes.len() / 2), &cut);
    parts.refuse_bytes(|bytes| bytes.truncate(bytes.len() - 1), &cut);
    parts.refuse_bytes(|bytes| bytes.extend(b"more"), &cut);
    parts.refuse_bytes(Vec::clear, &cut);
    parts.refuse_bytes(|bytes| bytes.fill(b'x'), &cut);
    let whole = zstd::decode_all(&fs::read(parts.sandbox.path("truths.tar.zst")).unwrap()[..]);
    let mut whole = whole.unwrap();
    whole.extend([1; 512]);
    compress(&parts.sandbox.path("forged.tar.zst"), &whole);
    parts.refused(&["goes on behind its last file"]);
    // A header that promises more than there is.
    let mut huge = whole.clone();
    let header = tar::Header::from_byte_slice(&huge[..512]);
    let mut header = header.clone();
    header.set_size(1 << 36);
    header.set_cksum();
    huge[..512].copy_from_slice(header.as_bytes());
    compress(&parts.sandbox.path("forged.tar.zst"), &huge);
    parts.refused(&["manifest.json"]);
}

#[test]
fn a_file_whose_header_has_another_hash_than_the_manifest_is_refused() {
    let parts = Parts::new();
    run(
        &parts.sandbox,
        "identity",
        &["--seed", "2", "--out", "other"],
    );
    let pack = ["truths", "pack", "other", "--out", "other.tar.zst"];
    parts.sandbox.execute(&pack);
    let other = entries(&parts.sandbox.path("other.tar.zst"));
    let other: Manifest = serde_json::from_slice(&other[0].bytes).unwrap();
    let mut forged = parts.entries.clone();
    change_manifest(&mut forged, |manifest| {
        for (file, other) in manifest.files.iter_mut().zip(&other.files) {
            file.content_hash.clone_from(&other.content_hash);
        }
    });
    write(&parts.sandbox.path("forged.tar.zst"), &forged);
    let words = "run --filter identity --seed 2 --truths forged.tar.zst --out fresh";
    let output = (parts.sandbox).shuttertruth(&[&split(words)[..], &split(QUICK)].concat());
    let found = ["has another content_hash than manifest.json says"];
    assert_refused(&output, 2, &found);
    assert!(!parts.sandbox.path("fresh/plate").exists());
}

#[test]
fn a_check_refuses_a_pack_that_git_tracks() {
    let sandbox = packed();
    sandbox.write_bound(1.0);
    let git = |words: &[&str]| {
        let mut git = Command::new("git");
        let output = git
            .current_dir(sandbox.path(""))
            .args(words)
            .output()
            .unwrap();
        assert!(output.status.success(), "git {words:?}: {output:?}");
    };
    let check = || {
        let words = [&quick_command("check", "16")[..], &["--filter", "identity"]].concat();
        sandbox.outside_ci(&[&words[..], &["--truths", "truths.tar.zst"]].concat())
    };
    git(&["init", "-q"]);
    git(&["add", "scenes"]);
    assert_eq!(
        check().status.code(),
        Some(0),
        "it lies beside tracked files"
    );
    git(&["add", "truths.tar.zst"]);
    let parts = ["truths.tar.zst is tracked by git", "--truths"];
    assert_refused(&check(), 2, &parts);
}

#[test]
fn truths_that_are_neither_a_folder_nor_a_file_are_refused() {
    let sandbox = Sandbox::new();
    make_fifo(&sandbox.path("pipe"));
    let words = "run --filter identity --truths pipe --out fresh";
    let output = sandbox.shuttertruth(&[&split(words)[..], &split(QUICK)].concat());
    let parts = ["--truths pipe: is neither a folder nor a regular file"];
    assert_refused(&output, 2, &parts);
}
