//! The program as its user meets it: what it prints, what it writes, how it ends.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const OBJ: &str = "\
mtllib plate.mtl
v -0.5 -0.5 0
v 0.5 -0.5 0
v 0.5 0.5 0
v -0.5 0.5 0
usemtl paint
f 1 2 3
f 1 3 4
";

const MTL: &str = "newmtl paint\nKd 0 0 0\nKe 0.7 0.4 0.2\n";

/// 60 degrees of vertical field of view seen from 4 m: 0.4 m is about 2.7 px of 32 px rows.
const SCENE: &str = "\
exposes = \"nothing: it serves the tests of the command line\"
family = \"translation\"
exposure = 0.5
size = [64, 32]

[camera]
position = [0, 0, 4]
look_at = [0, 0, 0]
vertical_fov = 60.0

[background]
constant = [0.2, 0.2, 0.2]

[object.plate]
mesh = \"plate.obj\"
keys = [
    { time = -1, translation = [-1.6, 0, 0] },
    { time = 0, translation = [0, 0, 0] },
]
";

/// A folder of scenes with one scene `plate`, and an `out` that does not exist yet.
struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        let bench = Self {
            folder: tempfile::tempdir().unwrap(),
        };
        fs::create_dir_all(bench.path("scenes/plate")).unwrap();
        bench.write("scene.toml", SCENE);
        bench.write("plate.obj", OBJ);
        bench.write("plate.mtl", MTL);
        bench
    }

    fn path(&self, below: &str) -> PathBuf {
        self.folder.path().join(below)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path("scenes/plate").join(name), text).unwrap();
    }

    fn shuttertruth(&self, words: &[&str]) -> Output {
        self.command(words).output().unwrap()
    }

    fn command(&self, words: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_shuttertruth"));
        command.current_dir(self.folder.path()).args(words);
        command
    }

    /// `run` with few samples; the table is on standard output.
    fn run(&self, more: &[&str]) -> Output {
        let words = [
            "run",
            "--quiet",
            "--out",
            "out",
            "--size",
            "64x32",
            "--samples-per-pixel",
            "16",
        ];
        self.shuttertruth(&[&words, more].concat())
    }
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[track_caller]
fn assert_done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
}

#[track_caller]
fn assert_refused(output: &Output, code: i32, parts: &[&str]) {
    let message = stderr(output);
    assert_eq!(output.status.code(), Some(code), "{message}");
    for part in parts {
        assert!(
            message.contains(part),
            "\"{part}\" is missing from: {message}"
        );
    }
    assert_eq!(
        stdout(output),
        "",
        "a refused command prints nothing on standard output"
    );
}

fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
        {
            if entry.is_dir() {
                folders.push(entry)
            } else {
                files.push(entry)
            }
        }
    }
    files.sort();
    files
}

#[test]
fn a_run_writes_scores_and_pictures_of_every_case() {
    let bench = Bench::new();
    let output = bench.run(&["--filters", "identity,jump_flood:paper"]);
    assert_done(&output);
    let table = stdout(&output);
    for words in [
        "plate",
        "identity:",
        "jump_flood:paper",
        "FLIP",
        "PSNR",
        "growth",
        "bleed",
        "TV",
        "N_eq",
    ] {
        assert!(
            table.contains(words),
            "\"{words}\" is missing from:\n{table}"
        );
    }
    assert!(
        table
            .lines()
            .all(|line| line.chars().count() <= 80 || line.starts_with("written")),
        "{table}"
    );

    let run: suite::Run =
        serde_json::from_slice(&fs::read(bench.path("out/run.json")).unwrap()).unwrap();
    assert_eq!(
        (run.format, run.width, run.height, run.samples_per_pixel),
        (suite::FORMAT, 64, 32, 16)
    );
    let names: Vec<_> = run
        .cases
        .iter()
        .map(|case| (case.scene.as_str(), case.filter.as_str()))
        .collect();
    assert_eq!(names, [("plate", "identity"), ("plate", "jump_flood")]);
    for case in &run.cases {
        for name in ["output.png", "output.exr", "flip.png", "errors.exr"] {
            let path = bench.path("out").join(&case.folder).join(name);
            assert!(path.is_file(), "{} was not written", path.display());
        }
    }
    for name in [
        "frame.exr",
        "frame.png",
        "truth_trailing.exr",
        "truth_trailing.png",
        "ladder_trailing.exr",
    ] {
        assert!(
            bench.path("out/plate").join(name).is_file(),
            "out/plate/{name} was not written"
        );
    }
}

#[test]
fn json_goes_to_standard_output_where_a_machine_reads() {
    let bench = Bench::new();
    let output = bench.run(&["--filters", "identity", "--json"]);
    assert_done(&output);
    assert_eq!(
        stdout(&output).trim_end(),
        fs::read_to_string(bench.path("out/run.json")).unwrap()
    );
}

#[test]
fn a_second_run_uses_the_truth_again_and_says_the_same() {
    let bench = Bench::new();
    let first = bench.run(&["--filters", "identity"]);
    assert_done(&first);
    let rendered = |bench: &Bench| {
        fs::metadata(bench.path("out/plate/truth_trailing.exr"))
            .unwrap()
            .modified()
            .unwrap()
    };
    let before = rendered(&bench);
    let second = bench.run(&["--filters", "identity"]);
    assert_eq!(stdout(&first), stdout(&second));
    assert_eq!(
        rendered(&bench),
        before,
        "the truth was rendered again though nothing had changed"
    );
    assert_done(&bench.run(&["--filters", "identity", "--seed", "2"]));
    assert_ne!(
        rendered(&bench),
        before,
        "another seed must render another truth"
    );
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let bench = Bench::new();
    let files = |threads: &str, out: &str| {
        let words = [
            "run",
            "--quiet",
            "--size",
            "64x32",
            "--samples-per-pixel",
            "16",
            "--filters",
            "identity",
        ];
        assert_done(
            &bench.shuttertruth(&[&words[..], &["--threads", threads, "--out", out]].concat()),
        );
        let folder = bench.path(out);
        files_below(&folder)
            .into_iter()
            .filter(|path| path.file_name().unwrap() != "run.json") // it records the command
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
fn a_rendered_frame_can_be_blurred_by_any_filter() {
    let bench = Bench::new();
    assert_done(&bench.shuttertruth(&[
        "render",
        "--quiet",
        "--out",
        "r",
        "--scenes",
        "plate",
        "--samples-per-pixel",
        "16",
        "--alignments",
        "trailing,centred",
    ]));
    assert_eq!(
        frame::Truth::read(&bench.path("r/plate/truth_centred.exr"))
            .unwrap()
            .size(),
        (64, 32)
    );
    let frame = frame::Frame::read(&bench.path("r/plate/frame.exr")).unwrap();
    for (filter, changes) in [
        ("identity", false),
        ("velocity_gather", true),
        ("jump_flood:corrected", true),
    ] {
        let words = [
            "blur",
            "--filter",
            filter,
            "--frame",
            "r/plate/frame.exr",
            "--out",
            "blurred.exr",
        ];
        assert_done(&bench.shuttertruth(&words));
        let blurred = frame::read_exr(&bench.path("blurred.exr")).unwrap();
        assert_eq!(
            blurred.color("").unwrap() != frame.color,
            changes,
            "{filter}"
        );
    }
}

#[test]
fn an_exr_of_an_engine_needs_only_the_channels_and_an_exposure() {
    let bench = Bench::new();
    let mut file = frame::ExrFile::new(16, 16);
    file.push_color("", &frame::Raster::filled(16, 16, [0.5; 3]));
    let words = [
        "blur",
        "--filter",
        "identity",
        "--frame",
        "engine.exr",
        "--out",
        "blurred.exr",
    ];
    let refused = |file: &frame::ExrFile, parts: &[&str]| {
        frame::write_exr(&bench.path("engine.exr"), file).unwrap();
        assert_refused(&bench.shuttertruth(&words), 2, parts);
        assert!(!bench.path("blurred.exr").exists());
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
    assert_done(&bench.shuttertruth(&[&words[..], &["--exposure", "0.5"]].concat()));
    fs::remove_file(bench.path("blurred.exr")).unwrap();
    let mut nan = ones.clone();
    nan.pixels[5 * 16 + 3] = f32::NAN;
    file.channels.retain(|channel| channel.name != "Z");
    file.push_plane("Z", &nan);
    file.set("exposure", 0.5);
    refused(&file, &["engine.exr: depth at (3, 5)", "finite"]);
    fs::write(bench.path("engine.exr"), b"no exr").unwrap();
    assert_refused(
        &bench.shuttertruth(&words),
        2,
        &["engine.exr: not a complete OpenEXR file"],
    );
}

#[test]
fn scenes_and_filters_of_ones_own_are_given_by_their_paths() {
    let bench = Bench::new();
    let mine = bench.path("my_blur");
    fs::create_dir(&mine).unwrap();
    let shaders = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shaders/velocity_gather");
    for entry in fs::read_dir(shaders).unwrap().map(Result::unwrap) {
        fs::copy(entry.path(), mine.join(entry.file_name())).unwrap();
    }
    let absolute = mine.display().to_string();
    for words in [
        ["--filter", "my_blur"],
        ["--filter", &absolute],
        ["--filters", "./my_blur:fine"],
    ] {
        let scene = ["--scenes", "./scenes/plate", "--scenes-dir", "nowhere"];
        let output = bench.run(&[&scene[..], &words[..]].concat());
        assert_done(&output);
        assert!(stdout(&output).contains("velocity_gather:fine"));
    }
    assert_refused(
        &bench.run(&["--filters", "my_blur"]),
        2,
        &["no built-in filter is called \"my_blur\"", "./my_blur"],
    );
}

#[test]
fn list_shows_scenes_filters_parameters_and_presets() {
    let bench = Bench::new();
    let output = bench.shuttertruth(&["list"]);
    assert_done(&output);
    for words in [
        "plate",
        "nothing: it serves",
        "identity",
        "velocity_gather",
        "jump_flood",
        "paper",
        "samples",
    ] {
        assert!(
            stdout(&output).contains(words),
            "\"{words}\" is missing from:\n{}",
            stdout(&output)
        );
    }
    let output = bench.shuttertruth(&["list", "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["scenes"][0]["name"], "plate");
    assert_eq!(
        json["filters"].as_array().unwrap().len(),
        filters::Filter::builtin_names().len()
    );
}

#[test]
fn adapters_are_listed_and_chosen_by_name() {
    let bench = Bench::new();
    let output = bench.shuttertruth(&["--list-adapters"]);
    assert_done(&output);
    assert!(stdout(&output).starts_with("0: "), "{}", stdout(&output));
    let output = bench.run(&["--filters", "identity", "--adapter", "no such card"]);
    assert_refused(&output, 2, &["no such card"]);
    assert!(
        !bench.path("out").exists(),
        "an adapter is looked for before anything is rendered"
    );
}

#[test]
fn no_adapter_is_exit_code_3_and_names_the_way_out() {
    let bench = Bench::new();
    let output = bench
        .command(&["run", "--out", "out"])
        .env("VK_DRIVER_FILES", "/no/driver.json")
        .env("VK_ICD_FILENAMES", "/no/driver.json")
        .output()
        .unwrap();
    assert_refused(&output, 3, &["mesa-vulkan-drivers"]);
    assert!(!bench.path("out").exists());
}

#[test]
fn words_that_do_not_fit_are_refused_with_what_is_allowed() {
    let bench = Bench::new();
    let rows: &[(&[&str], &[&str])] = &[
        (
            &["--scenes", "plates"],
            &["no scene \"plates\"", "allowed: plate"],
        ),
        (&["--scenes", "plate@fast"], &["fast"]),
        (&["--filters", "jumpflood"], &["jumpflood", "jump_flood"]),
        (&["--filters", "no/such/folder"], &["no/such/folder"]),
        (&["--filters", "jump_flood:fastest"], &["fastest", "paper"]),
        (&["--set", "jump_flood.sample=3"], &["sample", "samples"]),
        (&["--set", "jump_flood.samples=many"], &["samples", "many"]),
        (
            &["--set", "jump_flood.samples=1000000"],
            &["samples", "1000000"],
        ),
        (&["--set", "samples=3"], &["filter.parameter=value"]),
        (
            &["--set", "bevy.samples=3"],
            &["no filter \"bevy\" takes part"],
        ),
        (
            &["--exposure", "0"],
            &["exposure is 0 frames", "allowed: above 0"],
        ),
        (&["--exposure=-0.5"], &["exposure is -0.5 frames"]),
        (&["--samples-per-pixel", "100"], &["100", "allowed"]),
        (&["--threads", "0"], &["--threads 0"]),
        (
            &["--velocity", "backwards"],
            &["backwards", "instantaneous, previous_frame"],
        ),
        (&["--size", "10"], &["WIDTHxHEIGHT"]),
        (&["--scenes-dir", "nowhere"], &["nowhere"]),
    ];
    for (more, parts) in rows {
        let words = [&["run", "--quiet", "--out", "out"], *more].concat();
        assert_refused(&bench.shuttertruth(&words), 2, parts);
        assert!(
            !bench.path("out").exists(),
            "{more:?} left something behind"
        );
    }
    assert_refused(&bench.shuttertruth(&["run"]), 2, &["--out"]);
    assert_refused(&bench.shuttertruth(&[]), 2, &["run, render, blur, list"]);
}

#[test]
fn a_bad_scene_is_refused_with_file_and_line_and_leaves_nothing_behind() {
    let scene = |from: &str, to: &str| {
        assert!(SCENE.contains(from), "the scene has no \"{from}\"");
        ("scene.toml", SCENE.replace(from, to))
    };
    let obj = |from: &str, to: &str| ("plate.obj", OBJ.replacen(from, to, 1));
    let rows: Vec<((&str, String), &[&str])> = vec![
        (
            scene("family", "familiar = 3\nfamily"),
            &["scene.toml:2:", "familiar"],
        ),
        (scene("plate.obj", "plane.obj"), &["plane.obj"]),
        (
            ("plate.obj", "# nothing\n".into()),
            &["plate.obj: holds no faces"],
        ),
        (
            obj("v 0.5 -0.5 0", "v 0.5 nan 0"),
            &["plate.obj:3:", "allowed"],
        ),
        (obj("f 1 3 4", "f 1 3 9"), &["plate.obj:8:", "9", "4"]),
        (
            scene("keys = [", "rotation = [0, 0, 0, 0]\nunused = ["),
            &["scene.toml:"],
        ),
        (
            scene(
                "translation = [0, 0, 0] },",
                "translation = [0, 0, 0], rotation = [0, 0, 0, 0] },",
            ),
            &["scene.toml:18:", "length is not above 0"],
        ),
        (scene("time = -1", "time = 2"), &["scene.toml:", "time"]),
        (
            scene("exposure = 0.5", "exposure = -0.5"),
            &["scene.toml:3:", "-0.5", "above 0"],
        ),
        (
            scene("look_at = [0, 0, 0]", "look_at = [0, 0, 4]"),
            &["scene.toml:", "look_at"],
        ),
        (
            scene("vertical_fov = 60.0", "vertical_fov = 180.0"),
            &["scene.toml:9:", "180"],
        ),
    ];
    for ((name, text), parts) in rows {
        let bench = Bench::new();
        bench.write(name, &text);
        let output = bench.run(&["--filters", "identity"]);
        assert_refused(&output, 2, parts);
        assert!(
            !bench.path("out").exists(),
            "{parts:?} left something behind"
        );
    }
}

#[test]
fn bounds_name_metrics_that_exist() {
    let bench = Bench::new();
    bench.write("bounds.toml", "flip_moving = 0.0001\n");
    assert_done(&bench.run(&["--filters", "identity"]));
    let run: suite::Run =
        serde_json::from_slice(&fs::read(bench.path("out/run.json")).unwrap()).unwrap();
    assert_eq!(run.cases[0].verdicts.len(), 1);
    bench.write("bounds.toml", "flip = 0.1\n");
    fs::remove_dir_all(bench.path("out")).unwrap();
    let output = bench.run(&["--filters", "identity"]);
    assert_refused(
        &output,
        2,
        &["bounds.toml", "metric \"flip\" is unknown", "flip_moving"],
    );
    assert!(!bench.path("out").exists());
}

#[test]
fn ctrl_c_leaves_no_broken_file() {
    let bench = Bench::new();
    // Far more samples than can be rendered before the interrupt.
    let mut child = bench
        .command(&[
            "render",
            "--quiet",
            "--out",
            "out",
            "--size",
            "1024x512",
            "--samples-per-pixel",
            "65536",
        ])
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(500));
    let interrupt = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(interrupt.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let out = bench.path("out");
    let left = if out.exists() {
        files_below(&out)
    } else {
        Vec::new()
    };
    assert!(left.is_empty(), "left behind: {left:?}");
}
