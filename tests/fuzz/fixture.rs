//! Real files of every kind. The program itself makes them before the first case, so that they always have today's
//! layout.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use tests::plate::{MTL, OBJ};

/// The program that is fuzzed.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_shuttertruth");

/// Options that every picture is rendered with.
pub const RENDER: [&str; 7] = [
    "--quiet",
    "--scenes",
    "plate",
    "--size",
    "16x16",
    "--samples-per-pixel",
    "16",
];

const SCENE: &str = "\
exposes = \"nothing: it serves the fuzzer\"
family = \"translation\"
exposure = 0.5
size = [16, 16]
camera = { position = [0, 0, 2], look_at = [0, 0, 0], vertical_fov = 60.0 }
background = { constant = [0.2, 0.2, 0.2] }

[object.plate]
mesh = \"plate.obj\"
keys = [{ time = -1, translation = [-0.8, 0, 0] }, { time = 0, translation = [0, 0, 0] }]
";

const BOUNDS: &str = "\
[default]
flip_moving = { limit = 1, why = \"it is never more\", level = \"report\" }
static_contamination = { limit = 1, why = \"measured\" }

[filter.velocity_gather]
extent = { limit = 9, size = [16, 16], why = \"measured 1\" }

[margin]
flip_moving = 0.005
";

/// Temporary folder: `scenes`, `out` of a run, `tuned` and `study` of a tuning, `base.json`.
pub struct Fixture {
    folder: tempfile::TempDir,
}

impl Fixture {
    /// Runs the program a few times.
    pub fn make() -> Self {
        let fixture = Self {
            folder: tempfile::tempdir().expect("a folder for temporary files"),
        };
        fixture.write("scenes/plate/scene.toml", SCENE);
        fixture.write("scenes/plate/plate.obj", OBJ);
        fixture.write("scenes/plate/plate.mtl", MTL);
        fixture.write("scenes/bounds.toml", BOUNDS);
        let filters = "velocity_gather:departure,mcguire:paper";
        fixture.render(&["run"], &["--filters", filters, "--out", "out"]);
        let words = "bench --quiet --size 16x16 --filters velocity_gather:departure --out out";
        fixture.shuttertruth(&words.split(' ').collect::<Vec<_>>());
        let words = "limits accept --out out --reason first --baseline base.json --force";
        fixture.shuttertruth(&words.split(' ').collect::<Vec<_>>());
        let candidate = ["--filter", "velocity_gather", "--objective", "flip"];
        let tune = [&candidate[..], &["--out", "tuned", "--budget", "4"]].concat();
        fixture.render(&["tune", "search"], &tune);
        let study = [&candidate[..], &["--out", "study", "--rows", "2"]].concat();
        fixture.render(&["tune", "sensitivity"], &study);
        fixture
    }

    /// Returns the folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    fn render(&self, command: &[&str], more: &[&str]) {
        self.shuttertruth(&[command, &RENDER[..], more].concat());
    }

    fn shuttertruth(&self, words: &[&str]) {
        let mut command = Command::new(PROGRAM);
        command.current_dir(self.path()).args(words);
        let output = command.output().expect("the program can be started");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{}: {stderr}", words.join(" "));
    }
}

/// Copies a file, or a folder with its content.
pub fn copy(from: &Path, to: &Path) {
    if !from.is_dir() {
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(from, to).unwrap_or_else(|error| panic!("{}: {error}", from.display()));
        return;
    }
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        copy(&path, &to.join(path.file_name().unwrap()));
    }
}

/// Finds the files below a folder whose names end this way, sorted by path.
pub fn files(folder: &Path, end: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, end));
        } else if path.to_string_lossy().ends_with(end) {
            found.push(path);
        }
    }
    found.sort();
    found
}
