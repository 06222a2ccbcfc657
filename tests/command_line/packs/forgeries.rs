//! Packs whose files are not what they say, with right hashes: what a forger makes who knows the program.

use std::fs;
use std::path::Path;

use frame::Replicate;
use suite::{Monitor, TRAVERSALS, Verification};
use tests::filter_folder::one_kernel_without_parameters;

use super::{
    QUICK, REPLICATES, change_manifest, entries, packed, renew_truth, replicate_files, run, write,
};
use crate::sandbox::{Sandbox, assert_refused, split, stderr, stdout};

#[test]
fn a_truth_of_an_engine_is_no_success() {
    let sandbox = Sandbox::two_scenes();
    run(&sandbox, "identity", &[]);
    let (own, drawn) = (sandbox.path("out/slow"), sandbox.path("out/slow@engine"));
    fs::rename(own, &drawn).unwrap();
    for file in ["frame.exr", "truth_trailing.exr"] {
        mark_drawn(&drawn.join(file));
    }
    let parts = [
        "out/slow@engine: cannot be traced again",
        "only that engine can draw",
        "--scenes",
    ];
    assert_refused(&sandbox.shuttertruth(&["truths", "verify"]), 2, &parts);
    sandbox.execute(&["truths", "verify", "--scenes", "plate"]);
}

/// A scene of this program is traced, whatever its files say.
#[test]
fn a_file_that_says_that_an_engine_drew_it_is_traced() {
    let sandbox = packed();
    for file in ["truth_trailing.exr", "frame.exr"] {
        let path = sandbox.path("out/plate").join(file);
        let honest = fs::read(&path).unwrap();
        mark_drawn(&path);
        sandbox.execute(&["truths", "pack", "--out", "forged.tar.zst"]);
        let parts = [file, "attribute engine holds \"another\""];
        refuse(&sandbox, &parts);
        fs::write(&path, honest).unwrap();
    }
}

/// A folder of truths is the user's own, and is not traced again; but its headers do not decide either.
#[test]
fn a_kept_file_that_says_that_an_engine_drew_it_is_rendered_again() {
    let sandbox = packed();
    let files = ["frame.exr", "truth_trailing.exr", "ladder_trailing/n4.exr"];
    let all = files
        .map(str::to_owned)
        .into_iter()
        .chain(replicate_files());
    for file in all.clone() {
        mark_drawn(&sandbox.path("out/plate").join(file));
    }
    run(&sandbox, "identity", &["--truths", "out", "--out", "fresh"]);
    for file in all {
        let drawn = frame::read_attribute(&sandbox.path("fresh/plate").join(&file), "engine");
        assert_eq!(drawn, None, "{file}");
    }
    sandbox.execute(&["truths", "verify", "fresh"]);
}

/// Changes one attribute after another in all kept files, with right checksums, and the checksum itself.
#[test]
fn every_changed_attribute_is_found() {
    let sandbox = packed();
    let folder = sandbox.path("out/plate");
    let scene = tracer::load_scene(sandbox.path("scenes/plate"), None).unwrap();
    let kept = &suite::list_scene_renders(&sandbox.path("out"), Path::new("out")).unwrap()[0];
    let verification = Verification { seed: 5, tiles: 1 };
    let differences = || {
        let verified = suite::verify_scene(&scene, kept, &verification, Monitor::SILENT);
        // Settings that no truth can have are an error instead.
        verified.map_or_else(|error| vec![error.to_string()], |own| own.differences)
    };
    assert_eq!(differences(), Vec::<String>::new());
    let rungs = store::LADDER.map(|rung| format!("ladder_trailing/{}", frame::rung_file(rung)));
    let whole = ["frame.exr", "truth_trailing.exr"].map(str::to_owned);
    for file in whole.into_iter().chain(replicate_files()).chain(rungs) {
        let path = folder.join(&file);
        let (honest, bytes) = (frame::read_exr(&path).unwrap(), fs::read(&path).unwrap());
        let names = honest.attributes.keys().map(String::as_str);
        for name in names.filter(|name| *name != "checksum").chain(["engine"]) {
            let mut forged = honest.clone();
            let value = forged.attributes.get(name).map_or("0", String::as_str);
            let value = format!("{value}1");
            forged.set(name, value);
            frame::write_exr(&path, &forged).unwrap();
            let found = differences();
            assert_eq!(found.len(), 1, "{file}: {name} was changed: {found:?}");
        }
        // Written by the writer, and so changed in the bytes.
        let checksum = honest.get::<String>("checksum").unwrap();
        let text = checksum.as_bytes();
        let at = (bytes.windows(text.len())).position(|found| found == text);
        let mut forged = bytes.clone();
        forged[at.unwrap()] ^= 1;
        fs::write(&path, forged).unwrap();
        assert_eq!(differences().len(), 1, "{file}: its checksum was changed");
        fs::write(&path, bytes).unwrap();
    }
}

/// The words that a file may have are those that the tracer writes.
#[test]
fn the_instructions_of_all_machines_are_known() {
    let sandbox = Sandbox::new();
    let scene = tracer::load_scene(sandbox.path("scenes/plate"), None).unwrap();
    let stage = || tracer::Stage::new(&scene, 0.0, 0.0);
    for word in [stage().traversal(), stage().portable().traversal()] {
        assert!(TRAVERSALS.contains(&word), "{word}");
    }
}

/// Truths of half the brightness, for a filter that writes half the brightness.
#[test]
fn no_pack_turns_a_failed_check_into_a_success() {
    let sandbox = packed();
    let body = "textureStore(output, pixel, 0.5 * textureLoad(color, pixel, 0));";
    sandbox.write_filter("half", MANIFEST, &one_kernel_without_parameters(body));
    sandbox.write_bound(0.4);
    let check = |pack: &str| {
        let words = format!("check --filter ./half --truths {pack} --out checked {QUICK}");
        let output = sandbox.outside_ci(&split(&words));
        _ = fs::remove_dir_all(sandbox.path("checked"));
        output
    };
    let output = check("truths.tar.zst");
    assert!(stderr(&output).contains("; nothing is rendered"));
    assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));

    for file in replicate_files() {
        let path = sandbox.path("out/plate").join(file);
        let mut replicate = Replicate::read(&path).unwrap();
        for pixel in &mut replicate.picture.color.pixels {
            *pixel = pixel.map(|value| 0.5 * value);
        }
        replicate.write(&path).unwrap();
    }
    renew_truth(&sandbox, "out");
    let pack = || drop(sandbox.execute(&["truths", "pack", "--out", "forged.tar.zst"]));
    let refuse_check = |parts: &[&str]| {
        let output = check("forged.tar.zst");
        assert_eq!(output.status.code(), Some(2), "{}", stdout(&output));
        tests::text::assert_contains(&stderr(&output), parts);
        refuse(&sandbox, parts);
    };
    let replicate = "forged.tar.zst/plate/truth_trailing/replicate_00";
    pack();
    refuse_check(&[replicate, "channel"]);
    // Without its truth, a run would make one of the replicates.
    leave_out(&sandbox, "plate/ladder_trailing/");
    leave_out(&sandbox, "plate/truth_trailing.exr");
    refuse_check(&[replicate, "channel"]);
    pack();
    leave_out(&sandbox, "plate/truth_trailing.exr");
    let ladder = "plate/ladder_trailing/n1.exr: there is no truth_trailing.exr beside it";
    refuse(&sandbox, &[ladder]);
    for file in ["truth_trailing.exr", "frame.exr"] {
        mark_drawn(&sandbox.path("out/plate").join(file));
        pack();
        refuse_check(&["attribute engine holds \"another\""]);
    }
}

/// A truth of eight replicates, and eight more that nobody traced.
#[test]
fn replicates_beyond_those_of_the_truth_are_traced_too() {
    let sandbox = packed();
    sandbox.execute(&split(
        "truths render --quiet --scenes plate --size 64x32 --samples-per-pixel 16 --replicates 16 --out more",
    ));
    for index in REPLICATES..2 * REPLICATES {
        let file = format!("plate/truth_trailing/replicate_{index:03}.exr");
        fs::copy(
            sandbox.path("more").join(&file),
            sandbox.path("out").join(&file),
        )
        .unwrap();
    }
    sandbox.execute(&["truths", "verify"]);
    let path = sandbox.path("out/plate/truth_trailing/replicate_012.exr");
    let mut replicate = Replicate::read(&path).unwrap();
    replicate.picture.color.pixels.fill([9.0; 3]);
    replicate.write(&path).unwrap();
    let verify = ["truths", "verify", "--tiles", "100"];
    let parts = ["replicate_012.exr", "channel"];
    assert_refused(&sandbox.shuttertruth(&verify), 1, &parts);
    replicate.provenance.engine = Some("another".to_owned());
    replicate.write(&path).unwrap();
    let parts = ["replicate_012.exr", "attribute engine"];
    assert_refused(&sandbox.shuttertruth(&verify), 1, &parts);
}

/// A part of a render has replicates and no truth.
#[test]
fn replicates_without_a_truth_are_traced_too() {
    let sandbox = Sandbox::new();
    sandbox.execute(&split(
        "truths render --quiet --scenes plate --size 64x32 --samples-per-pixel 16 --replicates 3..5 --out part",
    ));
    let printed = sandbox.execute(&["truths", "verify", "part"]);
    assert!(printed.starts_with("part: 1 tile of "), "{printed}");
    mark_drawn(&sandbox.path("part/plate/truth_trailing/replicate_004.exr"));
    let parts = ["replicate_004.exr", "attribute engine"];
    assert_refused(
        &sandbox.shuttertruth(&["truths", "verify", "part"]),
        1,
        &parts,
    );
}

/// Manifest of a filter of one pass.
const MANIFEST: &str = r#"
name = "half"
summary = "Writes half the brightness."
alignment = "trailing"

[[pass]]
entry = "work"
"#;

/// Refuses `forged.tar.zst` in `verify`, and in a run, which leaves nothing of it.
#[track_caller]
fn refuse(sandbox: &Sandbox, parts: &[&str]) {
    let verified = sandbox.shuttertruth(&["truths", "verify", "forged.tar.zst"]);
    assert_refused(&verified, 1, parts);
    let words = "run --filter identity --truths forged.tar.zst --out fresh";
    let output = sandbox.shuttertruth(&[&split(words)[..], &split(QUICK)].concat());
    assert_refused(&output, 2, parts);
    assert!(!sandbox.path("fresh/plate").exists());
    assert!(!sandbox.path("fresh/.shuttertruth.unpacked").exists());
}

/// Leaves files out of `forged.tar.zst` whose paths begin like this.
fn leave_out(sandbox: &Sandbox, begin: &str) {
    let path = sandbox.path("forged.tar.zst");
    let mut entries = entries(&path);
    let before = entries.len();
    entries.retain(|entry| !entry.name.starts_with(begin));
    assert!(entries.len() < before);
    let keep = |manifest: &mut store::Manifest| {
        (manifest.files).retain(|file| !file.path.starts_with(begin));
    };
    change_manifest(&mut entries, keep);
    write(&path, &entries);
}

/// Makes a file say that an engine drew it.
fn mark_drawn(path: &Path) {
    let mut file = frame::read_exr(path).unwrap();
    file.set("engine", "another");
    frame::write_exr(path, &file).unwrap();
}
