//! Pictures, truths and frames with huge claims, missing numbers or another shape.

use std::fs;

use frame::{ExrFile, Samples, read_exr, write_exr};

use crate::hostile::claims::{Claim, claims, png};
use crate::sandbox::{Sandbox, rows};

const TRUTH: &str = "out/plate/truth_trailing.exr";
const FRAME: &str = "out/plate/frame.exr";
const OUTPUT: &str = "out/plate/identity_default/output.exr";
const ERRORS: &str = "out/plate/identity_default/errors.exr";

/// Words that score the picture named after them.
const SCORE: &str = "score --truth out/plate/truth_trailing.exr --frame out/plate/frame.exr --ladder out/plate/ladder_trailing --image";
const PAGE: &str = "report out --html page.html";
const LAYERS: &str = "report out --exr layers";

#[track_caller]
fn refuse_score(sandbox: &Sandbox, image: &str, parts: &[&str]) {
    sandbox.refuse(&format!("{SCORE} {image}"), parts);
}

#[test]
fn headers_with_huge_claims_are_refused_before_allocation() {
    let sandbox = Sandbox::measured();
    let write = |name: &str, bytes: Vec<u8>| sandbox.put(name, bytes);
    write("whole.exr", Claim::default().file());
    sandbox.done(&format!("{SCORE} whole.exr"));
    for claim in claims("scored") {
        write("claim.exr", claim.file());
        refuse_score(&sandbox, "claim.exr", &["claim.exr", &claim.found]);
    }
    write("bomb.png", png(20_000, 20_000, [16, 2], 1 << 20));
    let found = "bomb.png: claims 20000x20000 pixels; allowed: up to 33554432";
    refuse_score(&sandbox, "bomb.png", &[found]);
    refuse_score(&sandbox, "out", &["out: cannot be scored"]);
    #[cfg(unix)]
    for name in ["zero.exr", "zero.png"] {
        std::os::unix::fs::symlink("/dev/zero", sandbox.path(name)).unwrap();
        refuse_score(&sandbox, name, &[name, "regular file"]);
    }
}

/// Changes a file of the run, with a valid checksum, and runs commands that must refuse it.
#[track_caller]
fn refuse_altered(
    sandbox: &Sandbox,
    path: &str,
    change: impl FnOnce(&mut ExrFile),
    commands: &[&str],
    parts: &[&str],
) {
    let path = sandbox.path(path);
    let (bytes, mut file) = (fs::read(&path).unwrap(), read_exr(&path).unwrap());
    change(&mut file);
    write_exr(&path, &file).unwrap();
    for command in commands {
        sandbox.refuse(command, parts);
    }
    assert!(!sandbox.path("page.html").exists());
    fs::write(&path, bytes).unwrap();
}

/// Writes a number to a pixel of the channels.
fn fill(file: &mut ExrFile, is_due: impl Fn(&str) -> bool, pixel: usize, value: f32) {
    for channel in &mut file.channels {
        match &mut channel.samples {
            Samples::F32(samples) if is_due(&channel.name) => samples[pixel] = value,
            _ => {}
        }
    }
}

#[test]
fn a_truth_or_frame_with_missing_or_invalid_numbers_is_refused() {
    let sandbox = Sandbox::measured();
    let score = format!("{SCORE} {OUTPUT}");
    for path in [TRUTH, FRAME] {
        let channels = read_exr(&sandbox.path(path)).unwrap().channels.into_iter();
        let real = channels.filter(|channel| matches!(channel.samples, Samples::F32(_)));
        // All layers pass through the same check, so a few of each file are enough.
        for name in real.map(|channel| channel.name).step_by(7) {
            let found = format!("{path}: channel \"{name}\" holds NaN at pixel (5, 1)");
            let change = |file: &mut ExrFile| fill(file, |own| own == name, 64 + 5, f32::NAN);
            refuse_altered(&sandbox, path, change, &[&score], &[&found]);
        }
        let change = |file: &mut ExrFile| {
            let is_kept = |name: &str| !name.starts_with("coverage") && name != "A.G";
            file.channels.retain(|channel| is_kept(&channel.name));
        };
        let parts = [path, "lacks the channel"];
        refuse_altered(&sandbox, path, change, &[&score], &parts);
    }
    for row in rows(include_str!("refusals.toml"), "attributes") {
        let path = format!("out/plate/{}", row[0]);
        let change = |file: &mut ExrFile| file.set(row[1], row[2]);
        refuse_altered(&sandbox, &path, change, &[&score], &[&path, row[3]]);
    }
}

/// Enlarges a file's picture by repeating its first pixel.
pub fn enlarge(file: &mut ExrFile) {
    (file.width, file.height) = (file.width + 4, file.height + 4);
    let count = (file.width * file.height) as usize;
    for channel in &mut file.channels {
        match &mut channel.samples {
            Samples::F32(samples) => samples.resize(count, samples[0]),
            Samples::U32(samples) => samples.resize(count, samples[0]),
        }
    }
}

#[test]
fn files_of_another_size_or_of_other_objects_are_refused() {
    let sandbox = Sandbox::measured();
    let score = format!("{SCORE} {OUTPUT}");
    for path in [TRUTH, FRAME] {
        refuse_altered(&sandbox, path, enlarge, &[&score, PAGE, LAYERS], &["68x36"]);
    }
    for path in [OUTPUT, ERRORS] {
        refuse_altered(&sandbox, path, enlarge, &[PAGE, LAYERS], &["68x36"]);
    }
    let rename = |file: &mut ExrFile| {
        let objects = file.get::<String>("objects").unwrap();
        file.set("objects", objects.replace("plate", "other"));
        for channel in &mut file.channels {
            channel.name = channel.name.replace("plate", "other");
        }
    };
    refuse_altered(&sandbox, TRUTH, rename, &[&score, PAGE], &["other"]);
}

#[test]
fn pictures_with_invalid_numbers_are_refused_or_shown() {
    let sandbox = Sandbox::measured();
    let place = "holds NaN at pixel (30, 16)";
    let nan = |file: &mut ExrFile| fill(file, |_| true, 64 * 16 + 30, f32::NAN);
    refuse_altered(&sandbox, OUTPUT, nan, &[PAGE], &["output.exr", place]);
    // The square of this radiance overflows.
    let bright = |file: &mut ExrFile| fill(file, |name| name == "R", 2 * 64 + 9, 1e30);
    let score = format!("{SCORE} {OUTPUT}");
    let place = "at pixel (9, 2)";
    let parts = ["the colour of the output holds 1", place, "at most"];
    refuse_altered(&sandbox, OUTPUT, bright, &[&score], &parts);
    let mut errors = read_exr(&sandbox.path(ERRORS)).unwrap();
    nan(&mut errors);
    write_exr(&sandbox.path(ERRORS), &errors).unwrap();
    sandbox.done(PAGE);
}
