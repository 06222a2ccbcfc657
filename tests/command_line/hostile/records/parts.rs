//! Files that `merge` must refuse as parts of a truth.

use std::fs;
use std::path::Path;
use std::process::Output;

use frame::{AtInstant, Raster, Replicate, Support};

use crate::sandbox::{Sandbox, assert_done, assert_refused, make_fifo, split};

const SECOND: &str = "b/plate/truth_trailing/replicate_001.exr";

/// Makes two parts: `a` with the frame and replicate 0, `b` with replicate 1.
fn parts() -> Sandbox {
    let sandbox = Sandbox::new();
    for (out, part) in [("a", "0..1"), ("b", "1..2")] {
        let words =
            format!("truths render --quiet --samples-per-pixel 16 --replicates {part} --out {out}");
        sandbox.execute(&split(&words));
    }
    sandbox
}

fn merge(sandbox: &Sandbox, parts: &[&str]) -> Output {
    let output = sandbox.shuttertruth(&[&["truths", "merge"], parts, &["--out", "whole"]].concat());
    if !output.status.success() {
        assert!(
            !sandbox.path("whole").exists(),
            "{parts:?} left something behind"
        );
    }
    output
}

/// Crops the border from a replicate.
fn smaller(replicate: &Replicate) -> Replicate {
    let AtInstant {
        frozen,
        unknowable,
        placed,
        offset,
        spread,
    } = &replicate.at_instant;
    let Support {
        seen,
        moving,
        unknowable: hidden,
    } = &replicate.support;
    Replicate {
        picture: replicate.picture.cropped(2),
        at_instant: AtInstant {
            frozen: frozen.cropped(2),
            unknowable: unknowable.cropped(2),
            placed: placed.cropped(2),
            offset: offset.cropped(2),
            spread: spread.cropped(2),
        },
        samples: replicate.samples.cropped(2),
        support: Support {
            seen: seen.iter().map(|mask| mask.cropped(2)).collect(),
            moving: moving.cropped(2),
            unknowable: hidden.cropped(2),
        },
        ..replicate.clone()
    }
}

#[test]
fn replicates_of_different_truths_are_refused() {
    let sandbox = parts();
    let path = sandbox.path(SECOND);
    let whole = Replicate::read(&path).unwrap();
    let refused = |replicate: &Replicate, found: &[&str]| {
        replicate.write(&path).unwrap();
        assert_refused(&merge(&sandbox, &["a", "b"]), 2, found);
    };
    refused(
        &smaller(&whole),
        &["plate/truth_trailing", "another size than replicate 0"],
    );

    let mut fewer = whole.clone();
    fewer.objects.truncate(1);
    fewer.moving.truncate(1);
    fewer.picture.coverage.truncate(1);
    fewer.support.seen.truncate(1);
    refused(&fewer, &["another list of objects than replicate 0"]);

    let mut more = whole.clone();
    more.provenance.samples_per_pixel = u32::MAX;
    refused(&more, &["another number of samples"]);

    let mut far = whole.clone();
    for (index, name) in [
        (u32::MAX - 1, "replicate_4294967294.exr"),
        (4000, "replicate_4000.exr"),
        (0, "replicate_000.exr"),
    ] {
        far.index = index;
        let held = format!("replicate_001.exr holds plate/truth_trailing/{name}");
        refused(&far, &[&held, "leave folders and names"]);
    }

    let mut foreign = whole.clone();
    foreign.provenance.content_hash = "00".repeat(32);
    refused(&foreign, &["made from other inputs"]);

    let mut stray = whole.clone();
    stray.provenance.scene = "../../etc".to_owned();
    refused(
        &stray,
        &["replicate_001.exr holds ../../etc/truth_trailing"],
    );

    let mut nan = whole.clone();
    nan.at_instant.spread = Raster::filled(64, 32, [f32::NAN; 3]);
    refused(
        &nan,
        &["replicate_001.exr: channel \"reference.xx\" holds NaN at pixel (0, 0)"],
    );

    whole.write(&path).unwrap();
    assert_refused(&merge(&sandbox, &["a", "b", "a"]), 2, &["a is named twice"]);
    assert_done(&merge(&sandbox, &["a", "b"]));
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
    assert_done(&merge(&sandbox, &["a", "b"]));
    fs::remove_dir_all(sandbox.path("whole")).unwrap();

    let path = sandbox.path(SECOND);
    fs::remove_file(&path).unwrap();
    let refused = || assert_refused(&merge(&sandbox, &["a", "b"]), 2, &["b holds no replicates"]);
    make_fifo(&path);
    refused();
    fs::remove_file(&path).unwrap();
    symlink("/dev/zero", &path).unwrap();
    refused();
    fs::remove_file(&path).unwrap();
    fs::create_dir(&path).unwrap();
    refused();
    assert_refused(
        &merge(&sandbox, &["a", "b/plate/none"]),
        2,
        &["b/plate/none: cannot read"],
    );
    fs::write(sandbox.path("file"), "").unwrap();
    assert_refused(&merge(&sandbox, &["a", "file"]), 2, &["file: cannot read"]);
    assert!(!Path::new("whole").exists());
}
