//! The program as its user sees it: output, files and exit codes.

mod arguments;
#[path = "../../crates/bench/tests/program/mod.rs"]
mod bench;
mod changes;
mod child;
#[cfg(unix)]
mod command_filter;
mod compare;
mod comparison;
mod compilers;
mod conventions;
mod earlier_run;
mod empty_folder;
#[path = "../../crates/engine/tests/program/mod.rs"]
mod engine;
mod exclusion;
mod expected_times;
mod exported_tables;
mod failures;
mod fidelity;
mod finished_sequence;
mod frame_rates;
mod further_velocities;
#[path = "../../crates/gate/tests/program/mod.rs"]
mod gate;
#[cfg(unix)]
mod growth;
mod guides;
mod half_floats;
mod hostile;
mod input_forms;
#[cfg(unix)]
mod interrupts;
mod kept;
mod kept_cases;
mod links;
#[cfg(target_os = "linux")]
mod look;
#[path = "../../crates/merge/tests/program/mod.rs"]
mod merge;
mod new;
mod noise;
mod own_filter;
mod pictures;
mod previous;
mod quotes;
mod reference_width;
mod refusals;
mod report;
mod results;
mod sandbox;
mod scene_notes;
#[path = "../../crates/score/tests/program/mod.rs"]
mod score;
mod sequences;
mod set_up;
mod settings;
mod shipped_files;
mod smears;
#[cfg(target_os = "linux")]
mod snakemake;
mod snapshots;
mod studies;
mod summary;
mod terminal;
#[path = "../../crates/tune/tests/program/mod.rs"]
mod tune;
mod variants;
mod written_files;

use std::fs;
use std::path::Path;
use std::process::Stdio;

use sandbox::{IDENTITY, Sandbox, assert_done, assert_same_files, read_below, split, stdout};

#[test]
fn a_run_writes_scores_and_pictures_of_every_case() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity,jump_flood:paper"]));
    let run = sandbox.read_run();
    assert_eq!(run.format, measure::FORMAT);
    assert_eq!(run.render.size().to_string(), "64x32");
    assert_eq!(run.render.samples_per_pixel, 16);
    assert!(run.cases.is_sorted_by_key(|case| !case.is_reference));
    let names = |is_reference| {
        let cases = (run.cases.iter()).filter(|case| case.is_reference == is_reference);
        cases.map(|case| case.name()).collect::<Vec<_>>().join(" ")
    };
    let references = "identity scatter_oracle accumulate:1 accumulate:4 accumulate:8 accumulate:16 accumulate:64";
    assert_eq!(names(true), references);
    assert_eq!(names(false), "identity:default jump_flood:paper");
    let of_cases = run.cases.iter().flat_map(|case| {
        ["output.png", "output.exr", "flip.png", "errors.exr"].map(|name| case.folder.join(name))
    });
    let of_scene = "frame.exr frame.png truth_trailing.exr truth_trailing.png ladder_trailing/n1.exr ladder_trailing/n64.exr";
    let of_scene = of_scene
        .split(' ')
        .map(|name| Path::new("plate").join(name));
    for name in of_cases.chain(of_scene) {
        let path = sandbox.path("out").join(name);
        assert!(path.is_file(), "{} was not written", path.display());
    }
}

#[test]
fn json_is_run_json() {
    let sandbox = Sandbox::measured();
    let json = sandbox.run(&[&IDENTITY[..], &["--json"]].concat());
    let kept = sandbox.text("out/run.json");
    assert_eq!(stdout(&json).trim_end(), kept);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    // Two threads measure two scenes side by side.
    let sandbox = Sandbox::two_scenes();
    let files = |threads: &str, out: &str| {
        let words = "run --quiet --size 64x32 --samples-per-pixel 16 --filters identity";
        let more = ["--threads", threads, "--out", out];
        sandbox.execute(&[&split(words)[..], &more].concat());
        let mut files = read_below(&sandbox.path(out));
        // run.json records the command, judgement.json names its run.json, the report shows both,
        // and page.json has its hash.
        let differing = ["run.json", "judgement.json", "report.html", "page.json"];
        files.retain(|(name, _)| !differing.iter().any(|file| name.ends_with(file)));
        files
    };
    let one = files("1", "one");
    assert!(one.len() > 5);
    assert_same_files(&one, &files("2", "two"));
}

#[test]
fn an_engine_s_exr_needs_only_the_channels_and_an_exposure() {
    let sandbox = Sandbox::new();
    let line = "engine blur --filter identity --frame engine.exr --out blurred.exr";
    let refused = |file: &frame::ExrFile, parts: &[&str]| {
        frame::write_exr(&sandbox.path("engine.exr"), file).unwrap();
        sandbox.refuse(line, parts);
        assert!(!sandbox.path("blurred.exr").exists());
    };
    let mut file = frame::ExrFile::new(16, 16);
    file.push_color("", &frame::Raster::filled(16, 16, [0.5; 3]));
    refused(&file, &["engine.exr: lacks the channel \"velocity.X\""]);
    let ones = frame::Raster::filled(16, 16, 1.0);
    for name in ["velocity.X", "velocity.Y", "Z"] {
        file.push_plane(name, &ones);
    }
    let parts = ["engine.exr: has no attribute \"exposure\"", "--exposure"];
    refused(&file, &parts);
    sandbox.done(&format!("{line} --exposure 0.5"));
    fs::remove_file(sandbox.path("blurred.exr")).unwrap();
    let mut nan = ones.clone();
    nan.pixels[5 * 16 + 3] = f32::NAN;
    file.channels.retain(|channel| channel.name != "Z");
    file.push_plane("Z", &nan);
    file.set("exposure", 0.5);
    refused(&file, &["engine.exr: depth at (3, 5)", "finite"]);
    sandbox.put("engine.exr", b"no exr");
    sandbox.refuse(line, &["engine.exr: not a complete OpenEXR file"]);
}

#[test]
fn a_closed_output_pipe_is_not_an_error() {
    let sandbox = Sandbox::new();
    let mut list = sandbox.command(&["list", "--json"]);
    list.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = list.spawn().unwrap();
    drop(child.stdout.take());
    assert_done(&child.wait_with_output().unwrap());
}
