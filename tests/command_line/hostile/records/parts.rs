//! Files that `merge` must refuse as parts of a truth.

use std::fs;

use frame::{Raster, Replicate, read_exr, write_exr};

use super::pictures::enlarge;
use crate::sandbox::{Sandbox, make_fifo};

const SECOND: &str = "b/plate/truth_trailing/replicate_001.exr";

/// Makes two parts: `a` with the frame and replicate 0, `b` with replicate 1.
fn parts() -> Sandbox {
    let sandbox = Sandbox::new();
    for (out, part) in [("a", "0..1"), ("b", "1..2")] {
        let words = "truths render --quiet --samples-per-pixel 16";
        sandbox.done(&format!("{words} --replicates {part} --out {out}"));
    }
    sandbox
}

/// Merges these parts, which must be refused and leave nothing behind.
#[track_caller]
fn refuse(sandbox: &Sandbox, parts: &str, words: &[&str]) {
    sandbox.refuse(&format!("truths merge {parts} --out whole"), words);
    assert!(!sandbox.path("whole").exists(), "{parts} left files");
}

fn merge(sandbox: &Sandbox) {
    sandbox.done("truths merge a b --out whole");
}

#[test]
fn replicates_of_different_truths_are_refused() {
    let sandbox = parts();
    let path = sandbox.path(SECOND);
    let whole = Replicate::read(&path).unwrap();
    let refused = |replicate: &Replicate, found: &[&str]| {
        replicate.write(&path).unwrap();
        refuse(&sandbox, "a b", found);
    };
    let mut larger = read_exr(&path).unwrap();
    enlarge(&mut larger);
    write_exr(&path, &larger).unwrap();
    let size = ["plate/truth_trailing", "another size than replicate 0"];
    refuse(&sandbox, "a b", &size);

    let mut fewer = whole.clone();
    fewer.objects.truncate(1);
    fewer.moving.truncate(1);
    fewer.picture.coverage.truncate(1);
    fewer.support.seen.truncate(1);
    refused(&fewer, &["another list of objects than replicate 0"]);

    for index in [u32::MAX - 1, 4000, 0] {
        let mut far = whole.clone();
        far.index = index;
        let held = format!("replicate_001.exr holds plate/truth_trailing/replicate_{index:03}.exr");
        refused(&far, &[&held, "leave folders and names"]);
    }

    let provenance = |change: &dyn Fn(&mut frame::Provenance)| {
        let mut changed = whole.clone();
        change(&mut changed.provenance);
        changed
    };
    let more = provenance(&|own| own.samples_per_pixel = u32::MAX);
    refused(&more, &["another number of samples"]);
    let stray = provenance(&|own| own.scene = "../../etc".to_owned());
    let part = "replicate_001.exr holds ../../etc/truth_trailing";
    refused(&stray, &[part]);

    let mut nan = whole.clone();
    nan.at_instant.spread = Raster::filled(64, 32, [f32::NAN; 2]);
    let place = "replicate_001.exr: channel \"reference.xx\" holds NaN at pixel (0, 0)";
    refused(&nan, &[place]);

    whole.write(&path).unwrap();
    refuse(&sandbox, "a b a", &["a is named twice"]);
    merge(&sandbox);
}

#[cfg(unix)]
#[test]
fn circular_links_and_pipes_are_not_read_as_parts() {
    use std::os::unix::fs::symlink;

    let sandbox = parts();
    for place in ["a/loop", "a/plate/loop", "a/plate/truth_trailing/loop"] {
        symlink(sandbox.path("a"), sandbox.path(place)).unwrap();
    }
    symlink(sandbox.path("a/itself"), sandbox.path("a/itself")).unwrap();
    merge(&sandbox);
    fs::remove_dir_all(sandbox.path("whole")).unwrap();

    let path = sandbox.path(SECOND);
    let kinds: [&dyn Fn(); 3] = [
        &|| make_fifo(&path),
        &|| symlink("/dev/zero", &path).unwrap(),
        &|| fs::create_dir(&path).unwrap(),
    ];
    for make in kinds {
        fs::remove_file(&path).unwrap();
        make();
        refuse(&sandbox, "a b", &["b holds no replicates"]);
    }
    sandbox.put("file", "");
    refuse(&sandbox, "a file", &["file: cannot read"]);
}
