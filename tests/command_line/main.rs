//! The program as its user meets it: output, files and exit codes.

mod arguments;
mod audit;
mod baseline;
mod check;
#[cfg(unix)]
mod command_filter;
mod compare;
mod comparison;
mod compilers;
mod conventions;
mod earlier_run;
mod empty_folder;
mod export;
mod failures;
mod fidelity;
mod finished_sequence;
mod frame_rates;
mod gallery;
#[cfg(unix)]
mod growth;
mod guides;
mod half_floats;
mod hostile;
mod import;
mod ingest;
mod input_forms;
#[cfg(unix)]
mod interrupts;
mod kept;
mod kept_cases;
mod links;
mod own_filter;
mod packs;
mod people;
mod python;
mod reference_width;
mod refusals;
mod report;
mod results;
mod rows;
mod sandbox;
mod score;
mod sequence_ranking;
mod sequences;
mod serve;
mod set_up;
mod shared_runs;
mod shipped_files;
#[cfg(target_os = "linux")]
mod snakemake;
mod snapshots;
mod summary;
mod terminal;
#[cfg(unix)]
mod threejs;
mod timing;
mod tune;
mod variants;

use std::fs;
use std::path::Path;
use std::process::Stdio;

use sandbox::{IDENTITY, Sandbox, assert_done, split, stdout};

#[test]
fn a_run_writes_scores_and_pictures_of_every_case() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity,jump_flood:paper"]));
    let run = sandbox.read_run();
    assert_eq!(run.format, suite::FORMAT);
    assert_eq!((run.render.width, run.render.height), (64, 32));
    assert_eq!(run.render.samples_per_pixel, 16);
    let names = run.cases.iter().map(|case| match case.is_reference {
        true => format!("reference {}", case.name()),
        false => case.name(),
    });
    let expected = [
        "reference identity",
        "reference scatter_oracle",
        "reference accumulate:1",
        "reference accumulate:4",
        "reference accumulate:8",
        "reference accumulate:16",
        "reference accumulate:64",
        "identity:default",
        "jump_flood:paper",
    ];
    assert_eq!(names.collect::<Vec<_>>(), expected);
    let of_cases = run.cases.iter().flat_map(|case| {
        ["output.png", "output.exr", "flip.png", "errors.exr"].map(|name| case.folder.join(name))
    });
    let of_scene = [
        "frame.exr",
        "frame.png",
        "truth_trailing.exr",
        "truth_trailing.png",
        "ladder_trailing/n1.exr",
        "ladder_trailing/n64.exr",
    ];
    for name in of_cases.chain(of_scene.map(|name| Path::new("plate").join(name))) {
        let path = sandbox.path("out").join(name);
        assert!(path.is_file(), "{} was not written", path.display());
    }
}

#[test]
fn a_second_run_reuses_the_truth_and_prints_the_same() {
    let sandbox = Sandbox::new();
    let printed = |more: &[&str]| {
        let output = sandbox.run(&[&IDENTITY, more].concat());
        assert_done(&output);
        stdout(&output)
    };
    let rendered = || {
        let truth = fs::metadata(sandbox.path("out/plate/truth_trailing.exr"));
        truth.unwrap().modified().unwrap()
    };
    let first = printed(&[]);
    let before = rendered();
    let second = printed(&[]);
    // Everything except the counts and the time in the last line.
    let ranking = |text: &str| text.split("\ncases: ").next().map(str::to_owned);
    assert_eq!(ranking(&first), ranking(&second));
    let json = printed(&["--json"]);
    let kept = fs::read_to_string(sandbox.path("out/run.json")).unwrap();
    assert_eq!(json.trim_end(), kept);
    assert_eq!(rendered(), before, "nothing had changed");
    printed(&["--seed", "2"]);
    assert_ne!(rendered(), before, "another seed needs another truth");
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let sandbox = Sandbox::new();
    let files = |threads: &str, out: &str| {
        let words = "run --quiet --size 64x32 --samples-per-pixel 16 --filters identity";
        let more = ["--threads", threads, "--out", out];
        sandbox.execute(&[&split(words)[..], &more].concat());
        let mut files = sandbox.read_files();
        // run.json records the command, judgement.json names its run.json, and the report shows both.
        let differing = ["run.json", "judgement.json", "report.html"];
        files.retain(|(name, _)| {
            name.starts_with(out) && !differing.iter().any(|file| name.ends_with(file))
        });
        files
    };
    let (one, two) = (files("1", "one"), files("2", "two"));
    assert!(one.len() > 5);
    assert_eq!(one.len(), two.len());
    for ((name, one), (other, two)) in one.iter().zip(&two) {
        assert_eq!(name.strip_prefix("one"), other.strip_prefix("two"));
        assert!(
            one == two,
            "{} differs between 1 and 2 threads",
            name.display()
        );
    }
}

#[test]
fn any_filter_can_blur_a_rendered_frame() {
    let sandbox = Sandbox::new();
    sandbox.execute(&split(
        "truths render --quiet --out r --scenes plate --samples-per-pixel 16 --alignments trailing,centred",
    ));
    let truth = frame::Truth::read(&sandbox.path("r/plate/truth_centred.exr")).unwrap();
    assert_eq!(truth.size(), (64, 32));
    let frame = frame::Frame::read(&sandbox.path("r/plate/frame.exr")).unwrap();
    for (filter, changes) in [
        ("identity", false),
        ("velocity_gather", true),
        ("jump_flood:corrected", true),
    ] {
        let words = "engine blur --frame r/plate/frame.exr --out blurred.exr --filter";
        sandbox.execute(&[&split(words)[..], &[filter]].concat());
        let blurred = frame::read_exr(&sandbox.path("blurred.exr")).unwrap();
        let changed = blurred.color("").unwrap() != frame.color;
        assert_eq!(changed, changes, "{filter}");
    }
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
    sandbox.execute(&split(&format!("{line} --exposure 0.5")));
    fs::remove_file(sandbox.path("blurred.exr")).unwrap();
    let mut nan = ones.clone();
    nan.pixels[5 * 16 + 3] = f32::NAN;
    file.channels.retain(|channel| channel.name != "Z");
    file.push_plane("Z", &nan);
    file.set("exposure", 0.5);
    refused(&file, &["engine.exr: depth at (3, 5)", "finite"]);
    fs::write(sandbox.path("engine.exr"), b"no exr").unwrap();
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
