//! Verification of kept truths: tiles traced again.

use std::fs;

use frame::{Frame, Ladder, Replicate};
use serde_json::Value;
use tests::text::Parts;

use super::{REPLICATES, change_replicate, pack_forged, packed, renew_truth, replicate_file, run};
use crate::sandbox::{Sandbox, assert_refused, split, stdout};

/// Verifies and returns what is printed as JSON.
fn verify(sandbox: &Sandbox, words: &str) -> Value {
    let line = format!("truths verify --json {words}");
    serde_json::from_str(&sandbox.done(&line)).unwrap()
}

/// Verifies, and expects a difference.
#[track_caller]
fn find(sandbox: &Sandbox, words: &str, parts: &(impl Parts + ?Sized)) {
    let output = sandbox.shuttertruth(&split(&format!("truths verify {words}")));
    assert_refused(&output, 1, parts);
}

/// Finds the tile of the one file with a text in its name: the file, and a pixel in the middle of the tile.
fn find_tile(verified: &Value, part: &str) -> (String, [u32; 2]) {
    let mut tiles = verified["tiles"].as_array().unwrap().iter();
    let tile = tiles.find(|tile| tile["file"].as_str().unwrap().contains(part));
    let tile = tile.unwrap();
    let number = |key: &str| tile[key].as_u64().unwrap() as u32;
    let x = number("x") + number("width") / 2;
    let y = number("y") + number("height") / 2;
    (tile["file"].as_str().unwrap().to_owned(), [x, y])
}

/// Changes the lowest bit of one number of a replicate.
fn flip_bit(replicate: &mut Replicate, x: u32, y: u32) {
    let red = &mut replicate.picture.color.pixels[(y * 64 + x) as usize][0];
    *red = f32::from_bits(red.to_bits() ^ 1);
}

#[test]
fn honest_truths_are_equal_on_any_number_of_threads() {
    let sandbox = Sandbox::new();
    // Both shutters, a guard band, and an exposure that no scene has.
    let more = "--exposure 0.3 --guard-band 3 --velocity previous_frame";
    run(&sandbox, &format!("--filter identity,kino:default {more}"));
    sandbox.done("truths pack");
    let verified = ["1 out", "3 out", "2 truths.tar.zst"].map(|threads| {
        let verified = verify(&sandbox, &format!("--seed 7 --tiles 5 --threads {threads}"));
        assert_eq!(verified["truths"], 2);
        assert_eq!(verified["seed"], 7);
        // The frame, two replicates and two rungs.
        assert_eq!(verified["tiles"].as_array().unwrap().len(), 5 * 5);
        verified.to_string().replace("truths.tar.zst/", "out/")
    });
    assert_eq!(verified[0], verified[1]);
    assert_eq!(verified[0], verified[2]);
    let printed = sandbox.done("truths verify");
    let begin = "out: 5 tiles of 16x16 pixels traced again and equal; 2 truths";
    assert!(printed.starts_with(begin), "{printed}");
    // An unnamed seed differs each time.
    assert_ne!(printed, sandbox.done("truths verify"));
}

#[test]
fn a_bit_in_a_replicate_is_found_where_a_tile_covers_it() {
    let sandbox = packed();
    let honest = verify(&sandbox, "--seed 7");
    let (file, [x, y]) = find_tile(&honest, "replicate_");
    let before = fs::read(sandbox.path(&file)).unwrap();
    change_replicate(&sandbox.path(&file), |replicate| flip_bit(replicate, x, y));
    renew_truth(&sandbox);
    // Pack and manifest are made anew: all hashes are right.
    pack_forged(&sandbox);
    let below = file.strip_prefix("out/").unwrap();
    let place = format!("forged.tar.zst/{below}: pixel ({x}, {y}) of its channel R");
    let parts = "bits 0x | and this program makes | render plate again | seed 7";
    find(&sandbox, "forged.tar.zst --seed 7", parts);
    find(&sandbox, "forged.tar.zst --seed 7", &[place]);
    let output = sandbox.shuttertruth(&split("truths verify forged.tar.zst --seed 7 --json"));
    assert_eq!(output.status.code(), Some(1));
    let verified: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(verified["differences"].as_array().unwrap().len(), 1);

    // The tile of this seed is in one replicate, and finds nothing in another.
    sandbox.put(&file, before);
    let mut names = (0..REPLICATES).map(|index| format!("out/plate/{}", replicate_file(index)));
    let other = names.find(|name| *name != file).unwrap();
    let change = |replicate: &mut Replicate| flip_bit(replicate, 20, 12);
    change_replicate(&sandbox.path(&other), change);
    renew_truth(&sandbox);
    fs::remove_dir_all(sandbox.path("out/plate/ladder_trailing")).unwrap();
    verify(&sandbox, "--seed 7");
    let parts = [other.as_str(), "pixel (20, 12) of its channel R"];
    find(&sandbox, "--seed 7 --tiles 200", &parts);
}

#[test]
fn a_truth_that_is_not_the_mean_of_its_replicates_is_found_wherever_it_differs() {
    let sandbox = packed();
    let path = sandbox.path("out/plate").join(replicate_file(3));
    change_replicate(&path, |replicate| {
        replicate.picture.coverage[1].pixels[5 * 64 + 9] += 0.25;
    });
    let place = "out/plate/truth_trailing.exr: is not the mean of its replicates: pixel (9, 5)";
    find(&sandbox, "--seed 1", &[place, "use none of these files"]);
}

#[test]
fn a_frame_and_a_rung_are_verified_too() {
    let sandbox = packed();
    let honest = verify(&sandbox, "--seed 3");
    let (file, [x, y]) = find_tile(&honest, "frame.exr");
    let path = sandbox.path(&file);
    let whole = Frame::read(&path).unwrap();
    let pixel = (y * 64 + x) as usize;
    let refused = |file: &str, channel: &str| {
        let place = format!("{file}: pixel ({x}, {y}) of its channel {channel}");
        find(&sandbox, "--seed 3", &[&place]);
    };
    let mut frame = whole.clone();
    frame.velocity.pixels[pixel][0] += 1.0;
    frame.write(&path).unwrap();
    refused(&file, "velocity.X");
    let mut frame = whole.clone();
    frame.object_id.pixels[pixel] ^= 1;
    frame.write(&path).unwrap();
    refused(&file, "object.id");
    whole.write(&path).unwrap();
    verify(&sandbox, "--seed 3");

    let (file, [x, y]) = find_tile(&honest, "ladder_trailing");
    let path = sandbox.path(&file);
    let mut rung = Ladder::read(&path).unwrap();
    rung.rungs[0].halves[1].color.pixels[(y * 64 + x) as usize][2] += 1.0;
    rung.write(&path).unwrap();
    let place = format!("{file}: pixel ({x}, {y}) of its channel n");
    find(&sandbox, "--seed 3", &[&place]);
}

#[test]
fn truths_of_another_scene_are_no_truths_of_this_one() {
    let sandbox = packed();
    sandbox.edit("scenes/plate/scene.toml", "-1.6", "-1.5");
    let parts = "out/plate/frame.exr: was made of another scene | render it again | \
        out/plate/truth_trailing.exr: was made of another scene";
    find(&sandbox, "", parts);
    fs::remove_dir_all(sandbox.path("scenes/plate")).unwrap();
    sandbox.refuse("truths verify", &["scenes: holds no scene"]);
}

#[test]
fn what_holds_no_truth_is_refused() {
    let sandbox = packed();
    sandbox.refuse_rows(
        "truths verify",
        r#"
        nowhere => nowhere: there is no such file
        scenes => scenes: holds no truth
        --scenes fan => --scenes: no "fan" there; allowed: plate
        --tiles 0 => '0' for '--tiles <N>': 0 is not in 1..=10000"#,
    );
    // A truth without ladder or frame, as `render` leaves it, is verified as far as possible.
    sandbox.done("truths render --quiet --scenes plate --samples-per-pixel 16 --out r");
    let printed = sandbox.done("truths verify r");
    assert!(printed.starts_with("r: 2 tiles"), "{printed}");
}
