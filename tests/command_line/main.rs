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
use std::process::Stdio;

use sandbox::{Sandbox, assert_done, assert_refused, files_below, split, stdout};
use tests::filter_folder::copy_shipped_filter;
use tests::text::assert_contains;

#[test]
fn a_run_writes_scores_and_pictures_of_every_case() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity,jump_flood:paper"]));
    let run = sandbox.read_run();
    let render = &run.render;
    assert_eq!(run.format, suite::FORMAT);
    assert_eq!(
        (render.width, render.height, render.samples_per_pixel),
        (64, 32, 16)
    );
    let names: Vec<_> = run
        .cases
        .iter()
        .map(|case| (case.is_reference, case.name()))
        .collect();
    let expected = [
        (true, "identity"),
        (true, "scatter_oracle"),
        (true, "accumulate:1"),
        (true, "accumulate:4"),
        (true, "accumulate:8"),
        (true, "accumulate:16"),
        (true, "accumulate:64"),
        (false, "identity:default"),
        (false, "jump_flood:paper"),
    ];
    assert_eq!(names, expected.map(|(bar, name)| (bar, name.to_owned())));
    for case in &run.cases {
        for name in ["output.png", "output.exr", "flip.png", "errors.exr"] {
            let path = sandbox.path("out").join(&case.folder).join(name);
            assert!(path.is_file(), "{} was not written", path.display());
        }
    }
    for name in [
        "frame.exr",
        "frame.png",
        "truth_trailing.exr",
        "truth_trailing.png",
        "ladder_trailing/n1.exr",
        "ladder_trailing/n64.exr",
    ] {
        assert!(
            sandbox.path("out/plate").join(name).is_file(),
            "out/plate/{name} was not written"
        );
    }
}

#[test]
fn json_goes_to_standard_output() {
    let sandbox = Sandbox::new();
    let output = sandbox.run(&["--filters", "identity", "--json"]);
    assert_done(&output);
    assert_eq!(
        stdout(&output).trim_end(),
        fs::read_to_string(sandbox.path("out/run.json")).unwrap()
    );
}

#[test]
fn a_second_run_reuses_the_truth_and_prints_the_same() {
    let sandbox = Sandbox::new();
    let first = sandbox.run(&["--filters", "identity"]);
    assert_done(&first);
    let rendered = |sandbox: &Sandbox| {
        fs::metadata(sandbox.path("out/plate/truth_trailing.exr"))
            .unwrap()
            .modified()
            .unwrap()
    };
    let before = rendered(&sandbox);
    let second = sandbox.run(&["--filters", "identity"]);
    // Everything except the counts and the time in the last line.
    let ranking = |output| stdout(output).split("\ncases: ").next().map(str::to_owned);
    assert_eq!(ranking(&first), ranking(&second));
    assert_eq!(
        rendered(&sandbox),
        before,
        "the truth was rendered again though nothing had changed"
    );
    assert_done(&sandbox.run(&["--filters", "identity", "--seed", "2"]));
    assert_ne!(
        rendered(&sandbox),
        before,
        "another seed must render another truth"
    );
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let sandbox = Sandbox::new();
    let files = |threads: &str, out: &str| {
        let words = split("run --quiet --size 64x32 --samples-per-pixel 16 --filters identity");
        assert_done(
            &sandbox.shuttertruth(&[&words[..], &["--threads", threads, "--out", out]].concat()),
        );
        let folder = sandbox.path(out);
        files_below(&folder)
            .into_iter()
            // run.json records the command, judgement.json names its run.json, and the report shows both.
            .filter(|path| {
                let name = path.file_name().unwrap().to_str().unwrap();
                !["run.json", "judgement.json", "report.html"].contains(&name)
            })
            .map(|path| {
                (
                    path.strip_prefix(&folder).unwrap().to_owned(),
                    fs::read(&path).unwrap(),
                )
            })
            .collect::<Vec<_>>()
    };
    let (one, two) = (files("1", "one"), files("2", "two"));
    assert!(one.len() > 5);
    for ((name, one), (other, two)) in one.iter().zip(&two) {
        assert_eq!(name, other);
        assert!(
            one == two,
            "{} differs between 1 and 2 threads",
            name.display()
        );
    }
    assert_eq!(one.len(), two.len());
}

#[test]
fn any_filter_can_blur_a_rendered_frame() {
    let sandbox = Sandbox::new();
    sandbox.execute(&split("truths render --quiet --out r --scenes plate --samples-per-pixel 16 --alignments trailing,centred"));
    assert_eq!(
        frame::Truth::read(&sandbox.path("r/plate/truth_centred.exr"))
            .unwrap()
            .size(),
        (64, 32)
    );
    let frame = frame::Frame::read(&sandbox.path("r/plate/frame.exr")).unwrap();
    for (filter, changes) in [
        ("identity", false),
        ("velocity_gather", true),
        ("jump_flood:corrected", true),
    ] {
        let words = [
            "engine",
            "blur",
            "--filter",
            filter,
            "--frame",
            "r/plate/frame.exr",
            "--out",
            "blurred.exr",
        ];
        sandbox.execute(&words);
        let blurred = frame::read_exr(&sandbox.path("blurred.exr")).unwrap();
        assert_eq!(
            blurred.color("").unwrap() != frame.color,
            changes,
            "{filter}"
        );
    }
}

#[test]
fn an_engine_s_exr_needs_only_the_channels_and_an_exposure() {
    let sandbox = Sandbox::new();
    let mut file = frame::ExrFile::new(16, 16);
    file.push_color("", &frame::Raster::filled(16, 16, [0.5; 3]));
    let words = split("engine blur --filter identity --frame engine.exr --out blurred.exr");
    let refused = |file: &frame::ExrFile, parts: &[&str]| {
        frame::write_exr(&sandbox.path("engine.exr"), file).unwrap();
        assert_refused(&sandbox.shuttertruth(&words), 2, parts);
        assert!(!sandbox.path("blurred.exr").exists());
    };
    refused(&file, &["engine.exr: lacks the channel \"velocity.X\""]);
    let ones = frame::Raster::filled(16, 16, 1.0);
    for name in ["velocity.X", "velocity.Y", "Z"] {
        file.push_plane(name, &ones);
    }
    refused(
        &file,
        &["engine.exr: has no attribute \"exposure\"", "--exposure"],
    );
    sandbox.execute(&[&words[..], &["--exposure", "0.5"]].concat());
    fs::remove_file(sandbox.path("blurred.exr")).unwrap();
    let mut nan = ones.clone();
    nan.pixels[5 * 16 + 3] = f32::NAN;
    file.channels.retain(|channel| channel.name != "Z");
    file.push_plane("Z", &nan);
    file.set("exposure", 0.5);
    refused(&file, &["engine.exr: depth at (3, 5)", "finite"]);
    fs::write(sandbox.path("engine.exr"), b"no exr").unwrap();
    assert_refused(
        &sandbox.shuttertruth(&words),
        2,
        &["engine.exr: not a complete OpenEXR file"],
    );
}

#[test]
fn a_user_s_scenes_and_filters_are_given_by_path() {
    let sandbox = Sandbox::new();
    let mine = sandbox.path("my_blur");
    copy_shipped_filter("velocity_gather", &mine);
    let absolute = mine.display().to_string();
    for words in [
        ["--filter", "my_blur"],
        ["--filter", &absolute],
        ["--filters", "my_blur"],
        ["--filters", "./my_blur:fine"],
    ] {
        let scene = ["--scenes", "./scenes/plate", "--scenes-dir", "nowhere"];
        let output = sandbox.run(&[&scene[..], &words[..]].concat());
        assert_done(&output);
        assert!(stdout(&output).contains("velocity_gather:fine"));
    }
    assert_refused(
        &sandbox.run(&["--filters", "other_blur"]),
        2,
        &[
            "no built-in filter is called \"other_blur\"",
            "./other_blur",
        ],
    );
}

#[test]
fn list_shows_scenes_filters_parameters_and_presets() {
    let sandbox = Sandbox::new();
    let words = [
        "list",
        "plate",
        "identity",
        "velocity_gather",
        "jump_flood",
        "mcguire",
        "kino",
    ];
    let output = sandbox.shuttertruth(&words);
    assert_done(&output);
    assert_contains(
        &stdout(&output),
        &[
            "plate",
            "nothing: it serves",
            "identity",
            "velocity_gather",
            "jump_flood",
            "paper",
            "samples",
            "source: https://github.com/keijiro/KinoMotion at",
            "differs: Tiles hold 32-bit floats",
            "published: McGuire, Hennessy, Bukowski and Osman 2012",
            "made for pictures 1280 pixels wide",
            ".tile_size = 20 pixels",
        ],
    );
    let output = sandbox.shuttertruth(&["list", "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["scenes"][0]["name"], "plate");
    assert_eq!(
        json["filters"].as_array().unwrap().len(),
        filters::Filter::builtin_names().len()
    );
    let mut filters = json["filters"].as_array().unwrap().iter();
    let bevy = filters.find(|filter| filter["name"] == "bevy").unwrap();
    let source = &bevy["presets"][0]["source"];
    assert_eq!(source["repository"], "https://github.com/bevyengine/bevy");
    assert_eq!(source["commit"].as_str().unwrap().len(), 40);
    assert!(
        source["paths"][0]
            .as_str()
            .unwrap()
            .ends_with("motion_blur.wesl")
    );
    assert!(source["differs"].as_array().unwrap().len() > 1);
    assert_eq!(source["publication"], serde_json::Value::Null);
}

#[test]
fn a_closed_output_pipe_is_not_an_error() {
    let sandbox = Sandbox::new();
    let mut child = sandbox
        .command(&["list", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    assert_done(&child.wait_with_output().unwrap());
}

#[test]
fn adapters_are_listed_and_chosen_by_name() {
    let sandbox = Sandbox::new();
    let output = sandbox.shuttertruth(&["list", "adapters"]);
    assert_done(&output);
    assert!(stdout(&output).starts_with("0: "), "{}", stdout(&output));
    let output = sandbox.run(&["--filters", "identity", "--adapter", "no such card"]);
    assert_refused(&output, 2, &["no such card"]);
    assert!(
        !sandbox.path("out").exists(),
        "an adapter is looked for before anything is rendered"
    );
}
