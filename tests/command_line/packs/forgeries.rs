//! Packs with false files and right hashes, as made by a forger who knows the program.

use std::fs;
use std::path::Path;

use suite::{Monitor, TRAVERSALS, Verification};
use tests::text::{Parts, assert_contains};

use super::*;
use crate::sandbox::{Sandbox, assert_refused, split, stderr, stdout};

const VERIFY: &str = "truths verify";

/// Makes a file claim that an engine drew it.
fn mark_drawn(path: &Path) {
    let mut file = frame::read_exr(path).unwrap();
    file.set("engine", "another");
    frame::write_exr(path, &file).unwrap();
}

#[test]
fn a_truth_of_an_engine_is_no_success() {
    let sandbox = Sandbox::two_scenes();
    run(&sandbox, "--filter identity");
    let (own, drawn) = (sandbox.path("out/slow"), sandbox.path("out/slow@engine"));
    fs::rename(own, &drawn).unwrap();
    for file in ["frame.exr", "truth_trailing.exr"] {
        mark_drawn(&drawn.join(file));
    }
    let place = "out/slow@engine: cannot be traced again";
    sandbox.refuse(VERIFY, &[place, "only that engine can draw", "--scenes"]);
    sandbox.done("truths verify --scenes plate");
}

/// A folder of truths is the user's own and is not traced again, but its headers are not trusted either.
#[test]
fn a_kept_file_that_says_that_an_engine_drew_it_is_rendered_again() {
    let sandbox = packed();
    let files = ["frame.exr", "truth_trailing.exr", "ladder_trailing/n4.exr"];
    let files = files.map(str::to_owned).into_iter();
    let all = files.chain(replicate_files());
    for file in all.clone() {
        mark_drawn(&sandbox.path("out/plate").join(file));
    }
    run(&sandbox, "--filter identity --truths out --out fresh");
    for file in all {
        let drawn = frame::read_attribute(&sandbox.path("fresh/plate").join(&file), "engine");
        assert_eq!(drawn, None, "{file}");
    }
    sandbox.done("truths verify fresh");
}

/// Changes each attribute in turn in these kept files of a plate, with right checksums, and the checksum itself.
fn change_attributes(files: &[String]) {
    let sandbox = Sandbox::new();
    let run = "run --quiet --filter identity --size 16x16 --samples-per-pixel 16 --jitter-frames 2";
    sandbox.done(&format!("{run} --replicates 2"));
    let scene = tracer::load_scene(sandbox.path("scenes/plate"), None).unwrap();
    let kept = &suite::list_scene_renders(&sandbox.path("out"), Path::new("out")).unwrap()[0];
    let verification = Verification { seed: 5, tiles: 1 };
    let differences = || {
        let verified = suite::verify_scene(&scene, kept, &verification, Monitor::SILENT);
        // Settings that no truth can have are an error instead.
        verified.map_or_else(|error| vec![error.to_string()], |own| own.differences)
    };
    assert_eq!(differences(), Vec::<String>::new());
    for file in files {
        let path = sandbox.path("out/plate").join(file);
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
        let mut windows = bytes.windows(checksum.len());
        let at = windows.position(|found| found == checksum.as_bytes());
        let mut forged = bytes.clone();
        forged[at.unwrap()] ^= 1;
        fs::write(&path, forged).unwrap();
        assert_eq!(differences().len(), 1, "{file}: its checksum was changed");
        fs::write(&path, bytes).unwrap();
    }
}

/// Names the rungs of the ladder of a truth.
fn rungs() -> Vec<String> {
    let names = store::LADDER.map(|rung| format!("ladder_trailing/{}", frame::rung_file(rung)));
    names.to_vec()
}

#[test]
fn every_changed_attribute_is_found_in_a_file_of_each_kind() {
    let [frame, truth] = ["frame.exr", "truth_trailing.exr"].map(str::to_owned);
    change_attributes(&[frame, truth, replicate_file(1), rungs()[1].clone()]);
}

#[test]
#[ignore = "prove: every attribute of the other replicates and rungs of a scene"]
fn every_changed_attribute_is_found_in_all_replicates_and_rungs() {
    change_attributes(&[rungs(), vec![replicate_file(0)]].concat());
}

/// A file may only have the words that the tracer writes.
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
    sandbox.write_kernel("half", "", &[], body);
    sandbox.write_bound(0.4);
    let check = |pack: &str| {
        let words = format!("check --filter ./half --truths {pack} --out checked {QUICK}");
        let output = sandbox.outside_ci(&split(&words));
        _ = fs::remove_dir_all(sandbox.path("checked"));
        output
    };
    let output = check("truths.tar.zst");
    assert_contains(&stderr(&output), &["; nothing is rendered"]);
    assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));

    for file in replicate_files() {
        change_replicate(&sandbox.path("out/plate").join(file), |replicate| {
            for pixel in &mut replicate.picture.color.pixels {
                *pixel = pixel.map(|value| 0.5 * value);
            }
        });
    }
    renew_truth(&sandbox);
    let refuse = |parts: &dyn Parts| {
        let output = check("forged.tar.zst");
        assert_eq!(output.status.code(), Some(2), "{}", stdout(&output));
        assert_contains(&stderr(&output), parts);
        refuse_forged(&sandbox, 1, parts);
    };
    let replicate = "forged.tar.zst/plate/truth_trailing/replicate_00 | channel";
    pack_forged(&sandbox);
    refuse(&replicate);
    // Without its truth, a run would make one from the replicates.
    leave_out(&sandbox, "plate/ladder_trailing/");
    leave_out(&sandbox, "plate/truth_trailing.exr");
    refuse(&replicate);
    pack_forged(&sandbox);
    leave_out(&sandbox, "plate/truth_trailing.exr");
    let ladder = "plate/ladder_trailing/n1.exr: there is no truth_trailing.exr next to it";
    refuse_forged(&sandbox, 1, &[ladder]);
    for file in ["truth_trailing.exr", "frame.exr"] {
        mark_drawn(&sandbox.path("out/plate").join(file));
        pack_forged(&sandbox);
        refuse(&["attribute engine holds \"another\""]);
    }
}

/// Leaves files with this path prefix out of `forged.tar.zst`.
fn leave_out(sandbox: &Sandbox, begin: &str) {
    let path = sandbox.path("forged.tar.zst");
    let mut entries = entries(&path);
    let before = entries.len();
    entries.retain(|entry| !entry.name.starts_with(begin));
    assert!(entries.len() < before);
    change_manifest(&mut entries, |manifest| {
        (manifest.files).retain(|file| !file.path.starts_with(begin));
    });
    write(&path, &entries);
}

/// A truth of eight replicates, and more that nobody traced; and a part of a render, which has replicates and no truth.
#[test]
fn replicates_that_are_in_no_truth_are_traced_too() {
    let sandbox = packed();
    let render = "truths render --quiet --scenes plate --size 64x32 --samples-per-pixel 16";
    sandbox.done(&format!("{render} --replicates 8..10 --out part"));
    let printed = sandbox.done("truths verify part");
    assert!(printed.starts_with("part: 1 tile of "), "{printed}");
    for file in [8, 9].map(replicate_file) {
        let [from, to] = ["part/plate", "out/plate"].map(|below| sandbox.path(below).join(&file));
        fs::copy(from, to).unwrap();
    }
    sandbox.done(VERIFY);
    let path = |out: &str| sandbox.path(out).join("plate").join(replicate_file(9));
    let refuse = |line: &str, part: &str| {
        let output = sandbox.shuttertruth(&split(line));
        assert_refused(&output, 1, &["replicate_009.exr", part]);
    };
    change_replicate(&path("out"), |own| own.picture.color.pixels.fill([9.0; 3]));
    refuse("truths verify --tiles 100", "channel");
    for out in ["out", "part"] {
        mark_drawn(&path(out));
        let line = format!("truths verify {out} --tiles 100");
        refuse(&line, "attribute engine");
    }
}
