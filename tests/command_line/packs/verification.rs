//! Kept truths that are verified: tiles traced again.

use std::fs;
use std::path::Path;

use frame::{Frame, Ladder, Replicate};
use serde_json::Value;

use super::{QUICK, REPLICATES, forge, packed, renew_truth, run};
use crate::sandbox::{Sandbox, assert_done, assert_refused, split, stderr, stdout};

/// Verifies and returns what is printed as JSON.
fn verify(sandbox: &Sandbox, words: &[&str]) -> Value {
    let printed = sandbox.execute(&[&["truths", "verify", "--json"], words].concat());
    serde_json::from_str(&printed).unwrap()
}

/// A pixel in the middle of a tile.
fn middle(tile: &Value) -> [u32; 2] {
    let number = |key: &str| tile[key].as_u64().unwrap() as u32;
    [
        number("x") + number("width") / 2,
        number("y") + number("height") / 2,
    ]
}

/// The tile of the one file whose name holds a text.
fn find_tile<'a>(verified: &'a Value, part: &str) -> (&'a Value, String) {
    let mut tiles = verified["tiles"].as_array().unwrap().iter();
    let tile = tiles.find(|tile| tile["file"].as_str().unwrap().contains(part));
    let tile = tile.unwrap();
    (tile, tile["file"].as_str().unwrap().to_owned())
}

#[test]
fn honest_truths_are_equal_on_any_number_of_threads() {
    let sandbox = Sandbox::new();
    // Both shutters, a guard band, and an exposure that no scene has.
    let more = "--exposure 0.3 --guard-band 3 --velocity previous_frame";
    run(&sandbox, "identity,kino:default", &split(more));
    sandbox.execute(&["truths", "pack"]);
    let mut all = Vec::new();
    for (truths, threads) in [("out", "1"), ("out", "3"), ("truths.tar.zst", "2")] {
        let words = ["--seed", "7", "--tiles", "5", "--threads", threads, truths];
        let verified = verify(&sandbox, &words);
        assert_eq!(verified["truths"], 2);
        assert_eq!(verified["seed"], 7);
        // The frame, two replicates and two rungs.
        assert_eq!(verified["tiles"].as_array().unwrap().len(), 5 * 5);
        all.push(verified.to_string().replace("truths.tar.zst/", "out/"));
    }
    assert_eq!(all[0], all[1]);
    assert_eq!(all[0], all[2]);
    let printed = sandbox.execute(&["truths", "verify"]);
    assert!(
        printed.starts_with("out: 5 tiles of 16x16 pixels traced again and equal; 2 truths"),
        "{printed}"
    );
    // A choice that nobody named is another one each time.
    assert_ne!(printed, sandbox.execute(&["truths", "verify"]));
}

#[test]
fn a_bit_in_a_replicate_is_found_where_a_tile_covers_it() {
    let sandbox = packed();
    let honest = verify(&sandbox, &["--seed", "7"]);
    let (tile, file) = find_tile(&honest, "replicate_");
    let [x, y] = middle(tile);
    let before = fs::read(sandbox.path(&file)).unwrap();
    forge(&sandbox, "out", &file, (y * 64 + x) as usize);
    // Pack and manifest are made anew: all hashes are right.
    sandbox.execute(&["truths", "pack", "--out", "forged.tar.zst"]);
    let below = Path::new(&file).strip_prefix("out").unwrap();
    let place = format!(
        "forged.tar.zst/{}: pixel ({x}, {y}) of its channel R",
        below.display()
    );
    let parts = [
        &place,
        "bits 0x",
        "and this program makes",
        "render plate again",
        "seed 7",
    ];
    let output = sandbox.shuttertruth(&["truths", "verify", "forged.tar.zst", "--seed", "7"]);
    assert_refused(&output, 1, &parts);
    let output = sandbox.shuttertruth(&[
        "truths",
        "verify",
        "forged.tar.zst",
        "--seed",
        "7",
        "--json",
    ]);
    assert_eq!(output.status.code(), Some(1));
    let verified: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(verified["differences"].as_array().unwrap().len(), 1);

    // The tile of this seed lies in one replicate, and finds nothing in another.
    fs::write(sandbox.path(&file), before).unwrap();
    let number = (0..REPLICATES).find(|index| !file.contains(&format!("replicate_{index:03}")));
    let other = format!(
        "out/plate/truth_trailing/replicate_{:03}.exr",
        number.unwrap()
    );
    forge(&sandbox, "out", &other, 12 * 64 + 20);
    let folder = sandbox.path("out/plate/ladder_trailing");
    fs::rename(&folder, sandbox.path("ladder")).unwrap();
    verify(&sandbox, &["--seed", "7"]);
    let many = ["truths", "verify", "--seed", "7", "--tiles", "200"];
    let parts = [other.as_str(), "pixel (20, 12) of its channel R"];
    assert_refused(&sandbox.shuttertruth(&many), 1, &parts);
}

#[test]
fn a_truth_that_is_not_the_mean_of_its_replicates_is_found_wherever_it_differs() {
    let sandbox = packed();
    let file = "out/plate/truth_trailing/replicate_003.exr";
    let mut replicate = Replicate::read(&sandbox.path(file)).unwrap();
    let coverage = &mut replicate.picture.coverage[1].pixels[5 * 64 + 9];
    *coverage += 0.25;
    replicate.write(&sandbox.path(file)).unwrap();
    let parts = [
        "out/plate/truth_trailing.exr: is not the mean of its replicates: pixel (9, 5)",
        "use none of these files",
    ];
    let output = sandbox.shuttertruth(&["truths", "verify", "--seed", "1"]);
    assert_refused(&output, 1, &parts);
}

#[test]
fn a_frame_and_a_rung_are_verified_too() {
    let sandbox = packed();
    let honest = verify(&sandbox, &["--seed", "3"]);
    let (tile, file) = find_tile(&honest, "frame.exr");
    let path = sandbox.path(&file);
    let whole = Frame::read(&path).unwrap();
    let [x, y] = middle(tile);
    let pixel = (y * 64 + x) as usize;
    let refused = |channel: &str| {
        let place = format!("{file}: pixel ({x}, {y}) of its channel {channel}");
        let output = sandbox.shuttertruth(&["truths", "verify", "--seed", "3"]);
        assert_refused(&output, 1, &[&place]);
    };
    let mut frame = whole.clone();
    frame.velocity.pixels[pixel][0] += 1.0;
    frame.write(&path).unwrap();
    refused("velocity.X");
    let mut frame = whole.clone();
    frame.object_id.pixels[pixel] ^= 1;
    frame.write(&path).unwrap();
    refused("object.id");
    whole.write(&path).unwrap();
    verify(&sandbox, &["--seed", "3"]);

    let (tile, file) = find_tile(&honest, "ladder_trailing");
    let path = sandbox.path(&file);
    let [x, y] = middle(tile);
    let mut rung = Ladder::read(&path).unwrap();
    rung.rungs[0].halves[1].color.pixels[(y * 64 + x) as usize][2] += 1.0;
    rung.write(&path).unwrap();
    let place = format!("{file}: pixel ({x}, {y}) of its channel n");
    let output = sandbox.shuttertruth(&["truths", "verify", "--seed", "3"]);
    assert_refused(&output, 1, &[&place]);
}

#[test]
fn a_run_takes_nothing_from_a_pack_of_forged_truths() {
    let sandbox = packed();
    // Every pixel of every replicate, so that any tile finds it.
    for index in 0..REPLICATES {
        let path = sandbox.path(&format!(
            "out/plate/truth_trailing/replicate_{index:03}.exr"
        ));
        let mut replicate = Replicate::read(&path).unwrap();
        for pixel in &mut replicate.picture.color.pixels {
            pixel[1] += 0.01;
        }
        replicate.write(&path).unwrap();
    }
    renew_truth(&sandbox, "out");
    sandbox.execute(&["truths", "pack", "--out", "forged.tar.zst"]);
    let words = "run --filter identity --truths forged.tar.zst --out fresh";
    let output = sandbox.shuttertruth(&[&split(words)[..], &split(QUICK)].concat());
    let parts = [
        "forged.tar.zst/plate/truth_trailing/replicate_00",
        "channel G",
        "seed",
    ];
    assert_refused(&output, 2, &parts);
    assert!(!sandbox.path("fresh/plate").exists());
    assert!(!sandbox.path("fresh/.shuttertruth.unpacked").exists());
}

#[test]
fn truths_of_another_scene_are_no_truths_of_this_one() {
    let sandbox = packed();
    let scene = sandbox.path("scenes/plate/scene.toml");
    let text = fs::read_to_string(&scene).unwrap();
    fs::write(&scene, text.replace("-1.6", "-1.5")).unwrap();
    let parts = [
        "out/plate/frame.exr: was made of another scene",
        "out/plate/truth_trailing.exr: was made of another scene",
        "render it again",
    ];
    assert_refused(&sandbox.shuttertruth(&["truths", "verify"]), 1, &parts);
    fs::remove_dir_all(sandbox.path("scenes/plate")).unwrap();
    assert_refused(
        &sandbox.shuttertruth(&["truths", "verify"]),
        2,
        &["scenes: holds no scene"],
    );
}

#[test]
fn what_holds_no_truth_is_refused() {
    let sandbox = packed();
    let verify = |words: &[&str]| sandbox.shuttertruth(&[&["truths", "verify"], words].concat());
    assert_refused(
        &verify(&["nowhere"]),
        2,
        &["nowhere: there is no such file"],
    );
    assert_refused(&verify(&["scenes"]), 2, &["scenes: holds no truth"]);
    let parts = ["--scenes: no \"fan\" there", "allowed: plate"];
    assert_refused(&verify(&["--scenes", "fan"]), 2, &parts);
    assert_refused(
        &verify(&["--tiles", "0"]),
        2,
        &["'0' for '--tiles <N>': 0 is not in 1..=10000"],
    );
    // A truth without ladder or frame, as `render` leaves it, is verified as far as it goes.
    sandbox.execute(&split(
        "truths render --quiet --scenes plate --samples-per-pixel 16 --out r",
    ));
    let output = verify(&["r"]);
    assert_done(&output);
    assert!(
        stdout(&output).starts_with("r: 2 tiles"),
        "{}",
        stderr(&output)
    );
}
