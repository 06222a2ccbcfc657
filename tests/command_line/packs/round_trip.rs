//! Packs as a source of a run's truths, and verification of kept truths: tiles traced again.

use std::fs;
use std::process::Output;

use frame::{Frame, Ladder, Replicate, TracedFrame, read_exr, read_frame_replicates, write_exr};
use serde_json::Value;
use suite::TRAVERSALS;
use tests::text::{Parts, assert_contains};

use super::{
    QUICK, REPLICATES, change_replicate, entries, manifest, pack_forged, packed, quick,
    renew_truth, replicate_file, run,
};
use crate::sandbox::{Files, Sandbox, assert_done, assert_refused, split, stderr, stdout};

/// Reads all rendered files of a folder.
fn rendered(sandbox: &Sandbox, out: &str) -> Files {
    let below = |(path, bytes): (std::path::PathBuf, Vec<u8>)| {
        let name = path.strip_prefix(out).ok()?.to_str().unwrap().to_owned();
        let is_of = |folder: &str| name.contains(folder) && name.ends_with(".exr");
        let is_rendered = name.ends_with("frame.exr") || is_of("truth_") || is_of("ladder_");
        is_rendered.then(|| (name.into(), bytes))
    };
    sandbox.read_files().into_iter().filter_map(below).collect()
}

/// Records in every rendered file that another machine's instructions traced it. Nothing depends on them, and new files name others.
fn mark(sandbox: &Sandbox, out: &str) {
    for (name, _) in rendered(sandbox, out) {
        let path = sandbox.path(out).join(name);
        let mut file = read_exr(&path).unwrap();
        let own = file.get::<String>("traversal").unwrap();
        let other = TRAVERSALS.into_iter().find(|word| *word != own);
        file.set("traversal", other.unwrap());
        write_exr(&path, &file).unwrap();
    }
}

/// Asserts that two runs differ at most in their command lines.
#[track_caller]
fn assert_same_scores(sandbox: &Sandbox, outs: [&str; 2]) {
    let [one, other] = outs.map(|out| sandbox.read_comparable(out));
    assert_eq!(one, other);
}

/// Runs with the truths of the pack; returns the messages.
fn run_from_pack(sandbox: &Sandbox, line: &str) -> String {
    let output = quick(sandbox, &format!("run {line} --truths truths.tar.zst"));
    assert_done(&output);
    assert_says_whom_it_believes(&output, "truths.tar.zst");
    stderr(&output)
}

/// Asserts that a command said once who decides its verdict.
#[track_caller]
fn assert_says_whom_it_believes(output: &Output, truths: &str) {
    let said = stderr(output);
    let note = format!(
        "note: whoever wrote {truths} decides the scores and the verdict: its truths are believed\n"
    );
    assert_eq!(said.matches(&note).count(), 1, "{said}");
}

#[test]
fn a_check_with_truths_of_others_says_who_decides_its_verdict() {
    let sandbox = packed();
    sandbox.write_bound(1.0);
    for truths in ["truths.tar.zst", "out"] {
        let line = format!("check --filter identity --out fresh --truths {truths}");
        assert_says_whom_it_believes(&quick(&sandbox, &line), truths);
    }
}

#[test]
fn replicates_of_another_seed_in_a_finished_folder_are_named_with_a_way_out_that_works() {
    let sandbox = packed();
    let render = format!(
        "truths render --scenes plate --seed 2 --replicates 0..2 {}",
        QUICK.replace(" --jitter-frames 2", "")
    );
    sandbox.done(&render);
    let remove = "remove out/plate/truth_trailing.exr and the folder out/plate/truth_trailing, and";
    let refuse = |what: &str| {
        let parts = [
            what,
            "truth_trailing/replicate_000.exr: ",
            remove,
            "run it again",
        ];
        sandbox.refuse("truths pack", &parts);
    };
    refuse("something was rendered into this folder since");
    let verified = sandbox.shuttertruth(&split("truths verify out"));
    assert_refused(
        &verified,
        1,
        &["truth_trailing.exr: ", "from other inputs", remove],
    );
    // Only the replicates are gone; the truth would be read back without them.
    fs::remove_dir_all(sandbox.path("out/plate/truth_trailing")).unwrap();
    refuse("there is no such file");
    fs::remove_file(sandbox.path("out/plate/truth_trailing.exr")).unwrap();
    run(&sandbox, "--filter identity");
    sandbox.done("truths pack");
}

#[test]
fn a_check_from_a_pack_renders_nothing_and_has_the_same_scores() {
    let sandbox = Sandbox::two_scenes();
    sandbox.write_bound(1.0);
    sandbox.copy_bound("slow");
    // Filters of both shutters.
    let check = |more: &str| {
        let line = format!("check --filter identity,kino:default {QUICK} {more}");
        let output = sandbox.outside_ci(&split(&line));
        assert_done(&output);
        stderr(&output)
    };
    check("");
    mark(&sandbox, "out");
    sandbox.done("truths pack out --out kept/truths.tar.zst");
    fs::create_dir(sandbox.path("elsewhere")).unwrap();
    fs::rename(sandbox.path("kept"), sandbox.path("elsewhere/kept")).unwrap();
    let pack = "elsewhere/kept/truths.tar.zst";
    let from_pack = format!("--truths {pack} --out fresh");
    let parts = [pack, "traced 8 tiles again", "; nothing is rendered"];
    assert_contains(&check(&from_pack), &parts);
    // Each scene has a frame, two truths of eight replicates, and the sharp picture of the trailing shutter's middle.
    let kept = rendered(&sandbox, "out");
    assert_eq!(kept.len(), 2 * (1 + 2 * (1 + 8) + 1));
    let fresh = rendered(&sandbox, "fresh");
    assert!(kept == fresh, "a file was rendered again or differs");
    assert_same_scores(&sandbox, ["fresh", "out"]);
    assert!(!sandbox.path("fresh/.shuttertruth.unpacked").exists());
    // A second check finds all of it in its folder.
    assert_contains(&check(&from_pack), &["took no file; nothing is rendered"]);
}

#[test]
fn one_run_gives_one_archive_with_the_manifest_first() {
    let sandbox = packed();
    let first = fs::read(sandbox.path("truths.tar.zst")).unwrap();
    // Another sandbox, with files of another time.
    let copy = packed();
    let printed = copy.done("truths pack out --out again.tar.zst");
    assert_contains(&printed, &["written: again.tar.zst", "1 truth in 17 files"]);
    assert!(fs::read(copy.path("again.tar.zst")).unwrap() == first);

    let entries = entries(&sandbox.path("truths.tar.zst"));
    let manifest = manifest(&entries);
    assert_eq!(entries[0].name, "manifest.json");
    assert_eq!(manifest.format, store::PACK_FORMAT);
    assert_eq!(manifest.files.len(), entries.len() - 1);
    for (file, entry) in manifest.files.iter().zip(&entries[1..]) {
        assert_eq!(file.path, entry.name);
        assert_eq!(file.bytes, entry.bytes.len() as u64);
        assert_eq!(file.blake3, blake3::hash(&entry.bytes).to_hex().to_string());
        assert_eq!(file.scene, "plate");
        assert_eq!([file.width, file.height], [64, 32]);
    }
    let mut files = manifest.files.iter();
    let truth = files.find(|file| file.path == "plate/truth_trailing.exr");
    let truth_hash = &sandbox.read_run().cases[0].truth_hash;
    assert_eq!(&truth.unwrap().content_hash, truth_hash);
    assert_eq!(truth.unwrap().samples_per_pixel, 16);
}

#[test]
fn a_pack_of_chosen_scenes_leaves_the_others_to_be_rendered() {
    let sandbox = Sandbox::two_scenes();
    run(&sandbox, "--filter identity");
    sandbox.done("truths pack --scenes sl*");
    let said = run_from_pack(&sandbox, "--filter identity --out fresh");
    let parts = "took 17 files, and traced 3 tiles again | \
        renders what it lacks: frame of plate, trailing truth of plate.";
    assert_contains(&said, &parts);
    assert_same_scores(&sandbox, ["fresh", "out"]);
}

#[test]
fn truths_of_other_settings_stay_in_the_pack() {
    let sandbox = packed();
    let said = run_from_pack(&sandbox, "--filter identity --seed 2 --out other");
    let part = "took no file; renders what it lacks: frame of plate, trailing truth of plate";
    assert_contains(&said, &[part]);
    run(&sandbox, "--filter identity --seed 2 --out alone");
    assert_same_scores(&sandbox, ["other", "alone"]);
}

#[test]
fn later_frames_of_sequences_are_packed_too() {
    let sandbox = Sandbox::new();
    let sequence = "--filter identity --frames 2";
    run(&sandbox, sequence);
    mark(&sandbox, "out");
    sandbox.done("truths pack");
    let said = run_from_pack(&sandbox, &format!("{sequence} --out fresh"));
    assert_contains(&said, &["; nothing is rendered"]);
    assert!(rendered(&sandbox, "fresh") == rendered(&sandbox, "out"));
    assert_same_scores(&sandbox, ["fresh", "out"]);
    let printed = sandbox.done("truths verify truths.tar.zst");
    let parts = ["6 tiles of 16x16", "2 truths equal to the mean"];
    assert_contains(&printed, &parts);
}

#[test]
fn plans_and_calibrations_take_packs() {
    let sandbox = packed();
    let line = "truths plan --filter identity --truths truths.tar.zst --json";
    let plan = sandbox.done(&format!("{line} {QUICK}"));
    assert!(!plan.contains("truths/plate"), "they are in the pack");
    for line in plan.lines() {
        let job: serde_json::Value = serde_json::from_str(line).unwrap();
        let measures = job["arguments"][0] == "run";
        let inputs = job["inputs"].to_string();
        assert_eq!(inputs.contains("truths.tar.zst"), measures, "{line}");
    }
    let words = "limits calibrate --filter identity --size 64x32 --samples-per-pixel 16 --runs 2 --out seeds";
    let output = sandbox.shuttertruth(&split(&format!("{words} --truths truths.tar.zst")));
    assert_done(&output);
    // The first of the two seeds is the pack's. A calibration uses one rung of the ladder.
    let parts = "took 11 files | ; nothing is rendered | took no file; renders";
    assert_contains(&stderr(&output), &parts);
    assert!(sandbox.path("seeds/plate.bounds.toml").is_file());
}

#[test]
fn a_pack_removes_what_a_killed_one_left_and_nothing_else() {
    let sandbox = packed();
    fs::create_dir(sandbox.path("below")).unwrap();
    let killed = [".shuttertruth-killed.tmp", "below/.shuttertruth-killed.tmp"];
    let others = [".shuttertruth-notes", "kept.tmp"];
    for name in killed.into_iter().chain(others) {
        sandbox.put(name, "");
    }
    sandbox.done("truths pack");
    sandbox.done("truths pack --out below/truths.tar.zst");
    assert!(killed.iter().all(|name| !sandbox.path(name).exists()));
    assert!(others.iter().all(|name| sandbox.path(name).exists()));
}

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
    let replicates = read_frame_replicates(&path).unwrap();
    let write = |frame: Frame| {
        let replicates = replicates.clone();
        TracedFrame { frame, replicates }.write(&path).unwrap();
    };
    let pixel = (y * 64 + x) as usize;
    let refused = |file: &str, channel: &str| {
        let place = format!("{file}: pixel ({x}, {y}) of its channel {channel}");
        find(&sandbox, "--seed 3", &[&place]);
    };
    let mut frame = whole.clone();
    frame.velocity.pixels[pixel][0] += 1.0;
    write(frame);
    refused(&file, "velocity.X");
    let mut frame = whole.clone();
    frame.object_id.pixels[pixel] ^= 1;
    write(frame);
    refused(&file, "object.id");
    write(whole);
    verify(&sandbox, "--seed 3");

    let (file, [x, y]) = find_tile(&honest, "ladder_trailing");
    let path = sandbox.path(&file);
    let mut rung = Ladder::read(&path).unwrap();
    rung.rungs[0].groups[1].color.pixels[(y * 64 + x) as usize][2] += 1.0;
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
    sandbox.refuse_table("truths verify", "verify");
    // A truth without ladder or frame, as `render` leaves it, is verified as far as possible.
    sandbox.done("truths render --quiet --scenes plate --samples-per-pixel 16 --out r");
    let printed = sandbox.done("truths verify r");
    assert!(printed.starts_with("r: 2 tiles"), "{printed}");
}
