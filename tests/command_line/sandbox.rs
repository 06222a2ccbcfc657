//! A folder to try the program in.

use std::collections::BTreeMap;
use std::fs;
use std::panic::Location;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::SystemTime;

use serde::de::DeserializeOwned;
use tests::filter_folder;
pub use tests::plate::{MTL, OBJ};
use tests::text::assert_contains;
use walkdir::WalkDir;

/// Scene of a plate. The vertical field of view is 60 degrees from 4 m away, so 0.4 m is about 2.7
/// px of 32 px rows.
pub const SCENE: &str = include_str!("plate.toml");

/// Words that choose only the identity.
pub const IDENTITY: [&str; 2] = ["--filters", "identity"];

/// Temporary folder with one scene, `plate`, and an `out` that does not exist yet.
pub struct Sandbox {
    folder: tempfile::TempDir,
}

impl Sandbox {
    pub fn new() -> Self {
        let sandbox = Self::of(&Files::new());
        sandbox.write("scene.toml", SCENE);
        sandbox.write("plate.obj", OBJ);
        sandbox.write("plate.mtl", MTL);
        sandbox
    }

    /// Makes a sandbox with a second scene, which moves at half the speed.
    pub fn two_scenes() -> Self {
        let sandbox = Self::new();
        sandbox.add_slow_scene();
        sandbox
    }

    /// Adds the scene `slow`, which moves at half the plate's speed.
    pub fn add_slow_scene(&self) {
        self.copy_scene("slow", |text| text.replace("-1.6", "-0.8"));
    }

    pub fn path(&self, below: &str) -> PathBuf {
        self.folder.path().join(below)
    }

    /// Writes a file of the plate's scene.
    pub fn write(&self, name: &str, text: &str) {
        self.put(&format!("scenes/plate/{name}"), text);
    }

    /// Writes a file, whose folder is made if needed.
    pub fn put(&self, below: &str, content: impl AsRef<[u8]>) {
        let path = self.path(below);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }

    pub fn text(&self, below: &str) -> String {
        fs::read_to_string(self.path(below)).unwrap()
    }

    /// Returns when a file was written.
    pub fn written(&self, below: &str) -> SystemTime {
        let file = fs::metadata(self.path(below)).unwrap();
        file.modified().unwrap()
    }

    /// Replaces a text in a file.
    #[track_caller]
    pub fn edit(&self, below: &str, from: &str, to: &str) {
        let text = self.text(below);
        assert!(text.contains(from), "{below} lacks \"{from}\":\n{text}");
        self.put(below, text.replacen(from, to, 1));
    }

    /// Adds a scene that differs from the plate's only in its scene.toml.
    pub fn copy_scene(&self, name: &str, changed: impl FnOnce(&str) -> String) {
        for file in ["plate.obj", "plate.mtl"] {
            let text = self.text(&format!("scenes/plate/{file}"));
            self.put(&format!("scenes/{name}/{file}"), text);
        }
        let text = changed(SCENE);
        assert_ne!(text, SCENE, "a scene that is no other");
        self.put(&format!("scenes/{name}/scene.toml"), text);
    }

    /// Reads all files, for sandboxes that begin with them.
    pub fn read_files(&self) -> Files {
        read_below(self.folder.path())
    }

    /// Makes a sandbox from the files that `prepare` leaves in a new one; each place that calls
    /// this does so once for all tests.
    #[track_caller]
    pub fn once(prepare: impl FnOnce(&Self)) -> Self {
        static PLACES: Mutex<BTreeMap<&Location, Arc<OnceLock<Files>>>> =
            Mutex::new(BTreeMap::new());
        let mut places = PLACES.lock().unwrap();
        let files = places.entry(Location::caller()).or_default().clone();
        drop(places);
        Self::of(files.get_or_init(|| {
            let sandbox = Self::new();
            prepare(&sandbox);
            sandbox.read_files()
        }))
    }

    /// Makes a sandbox with a finished run of the identity in `out`.
    pub fn measured() -> Self {
        Self::once(|sandbox| drop(sandbox.measure("--filters identity")))
    }

    /// Makes a sandbox with a finished run of a gather in `out`.
    pub fn gathered() -> Self {
        Self::once(|sandbox| drop(sandbox.measure("--filters velocity_gather:fine")))
    }

    /// Makes a sandbox with a finished check of the identity in `out`, which keeps its only bound.
    pub fn checked() -> Self {
        Self::once(|sandbox| {
            sandbox.write_bound(0.9);
            assert_done(&sandbox.check(&IDENTITY));
        })
    }

    /// Makes a sandbox with these files.
    pub fn of(files: &Files) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let sandbox = Self { folder };
        sandbox.write_files("", files);
        sandbox
    }

    /// Writes files below a folder.
    pub fn write_files(&self, below: &str, files: &Files) {
        for (name, bytes) in files {
            let path = Path::new(below).join(name);
            self.put(path.to_str().unwrap(), bytes);
        }
    }

    /// Bounds `flip_moving` on the plate for every filter. The identity scores about 0.3.
    pub fn write_bound(&self, limit: f64) {
        let bound = format!("flip_moving = {{ limit = {limit:?}, why = \"it serves a test\" }}");
        self.write("bounds.toml", &format!("[default]\n{bound}\n"));
    }

    /// Bounds the same score on another scene.
    pub fn copy_bound(&self, scene: &str) {
        let bounds = self.text("scenes/plate/bounds.toml");
        self.put(&format!("scenes/{scene}/bounds.toml"), bounds);
    }

    /// Writes the filter `name`, with one file of kernels, to a folder of that name.
    pub fn write_filter(&self, name: &str, manifest: &str, kernels: &str) {
        filter_folder::write_filter(&self.path(name), name, manifest, kernels);
    }

    /// Writes a filter that is a shell script; see [`filter_folder::write_program`].
    pub fn write_program(&self, name: &str, lines: &str, more: &str) {
        filter_folder::write_program(&self.path(name), name, lines, more);
    }

    /// Writes a filter with one pass; see [`filter_folder::write_kernel`].
    pub fn write_kernel(&self, name: &str, more: &str, textures: &[&str], body: &str) {
        filter_folder::write_kernel(&self.path(name), more, textures, body);
    }

    pub fn shuttertruth(&self, words: &[&str]) -> Output {
        self.command(words).output().unwrap()
    }

    /// Runs a command that must succeed; returns its output.
    #[track_caller]
    pub fn execute(&self, words: &[&str]) -> String {
        let output = self.shuttertruth(words);
        assert_done(&output);
        stdout(&output)
    }

    /// Runs a command line that must succeed; returns its output.
    #[track_caller]
    pub fn done(&self, line: &str) -> String {
        self.execute(&split(line))
    }

    /// Runs a line that must be refused with exit code 2 and these words.
    #[track_caller]
    pub fn refuse<T: AsRef<str>>(&self, line: &str, parts: &[T]) {
        println!("{line}");
        assert_refused(&self.shuttertruth(&split(line)), 2, parts);
    }

    pub fn git(&self, line: &str) {
        let mut git = Command::new("git");
        let status = git.current_dir(self.path("")).args(split(line)).status();
        assert!(status.unwrap().success(), "git {line}");
    }

    /// Does the same for rows of more words of the command, and the parts of the message.
    #[track_caller]
    pub fn refuse_each(&self, command: &str, rows: &[(&str, &[&str])]) {
        for (words, parts) in rows {
            self.refuse(&format!("{command} {words}"), parts);
        }
    }

    /// Runs a command as if outside CI.
    pub fn outside_ci(&self, words: &[&str]) -> Output {
        let mut command = self.command(words);
        command.env_remove("CI").env_remove("GITHUB_STEP_SUMMARY");
        command.output().unwrap()
    }

    /// Runs a command as if without a Vulkan driver.
    pub fn without_adapter(&self, words: &[&str]) -> Output {
        let mut command = self.command(words);
        for name in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
            command.env(name, "/no/driver.json");
        }
        command.env_remove("CI").output().unwrap()
    }

    pub fn command(&self, words: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_shuttertruth"));
        command.current_dir(self.folder.path()).args(words);
        command
    }

    /// Runs `run` with few samples; the table is on standard output.
    pub fn run(&self, more: &[&str]) -> Output {
        self.shuttertruth(&[&quick_command("run", "16")[..], more].concat())
    }

    /// Runs `run` with few samples, which must succeed; returns its output.
    #[track_caller]
    pub fn measure(&self, line: &str) -> String {
        self.measure_into("out", line)
    }

    /// Does the same with another folder than `out`.
    #[track_caller]
    pub fn measure_into(&self, out: &str, line: &str) -> String {
        let mut words = quick_command("run", "16");
        words[3] = out;
        self.execute(&[&words[..], &split(line)].concat())
    }

    /// Runs `check` with few samples and outside CI; the report is on standard output.
    pub fn check(&self, more: &[&str]) -> Output {
        self.outside_ci(&[&quick_command("check", "64")[..], more].concat())
    }

    /// Reads run.json of the last run.
    pub fn read_run(&self) -> measure::Run {
        self.read_json("out/run.json")
    }

    /// Reads a file of JSON.
    pub fn read_json<T: DeserializeOwned>(&self, below: &str) -> T {
        serde_json::from_slice(&fs::read(self.path(below)).unwrap()).unwrap()
    }

    /// Reads run.json without the command line, which names other folders.
    pub fn read_comparable(&self, out: &str) -> serde_json::Value {
        let mut run: serde_json::Value = self.read_json(&format!("{out}/run.json"));
        run["command"].take();
        run
    }

    /// Reads the colour of an OpenEXR file.
    pub fn read_color(&self, below: &str) -> frame::Image {
        let file = frame::read_exr(&self.path(below)).unwrap();
        file.color("").unwrap()
    }

    /// Returns whether the process named in a file has ended. A zombie has: nobody has collected it
    /// yet.
    pub fn has_ended(&self, file: &str) -> bool {
        let pid = fs::read_to_string(self.path(file)).unwrap();
        let mut ps = Command::new("ps");
        let output = ps.args(["-o", "stat=", "-p", pid.trim_end()]).output();
        let state = stdout(&output.unwrap());
        state.is_empty() || state.starts_with('Z')
    }

    /// Reads the findings about the last run.
    pub fn read_findings(&self) -> Vec<judge::Finding> {
        let judgement = judge::Judgement::read(&self.read_run(), &self.path("out")).unwrap();
        judgement.expect("the run was judged").findings
    }

    /// Returns the last run's cases without the references.
    pub fn read_filter_cases(&self) -> Vec<measure::Case> {
        let cases = self.read_run().cases.into_iter();
        cases.filter(|case| !case.is_reference).collect()
    }

    /// Names the last run's cases without the references: `plate identity:default`.
    pub fn read_case_names(&self) -> Vec<String> {
        let cases = self.read_filter_cases();
        let names = cases
            .iter()
            .map(|case| format!("{} {}", case.scene, case.name()));
        names.collect()
    }
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[track_caller]
pub fn assert_done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
}

#[track_caller]
pub fn assert_refused<T: AsRef<str>>(output: &Output, code: i32, parts: &[T]) {
    let message = stderr(output);
    assert_eq!(output.status.code(), Some(code), "{message}");
    assert_contains(&message, parts);
    assert_eq!(stdout(output), "", "a refused command prints nothing");
}

/// Files by their names below a folder.
pub type Files = Vec<(PathBuf, Vec<u8>)>;

/// Reads all files below a folder.
pub fn read_below(folder: &Path) -> Files {
    let read = |path: PathBuf| {
        let name = path.strip_prefix(folder).unwrap().to_owned();
        (name, fs::read(&path).unwrap())
    };
    files_below(folder).into_iter().map(read).collect()
}

/// Fails with the name of a missing or different file.
#[track_caller]
pub fn assert_same_files(one: &Files, other: &Files) {
    let names =
        |files: &Files| -> Vec<PathBuf> { files.iter().map(|file| file.0.clone()).collect() };
    assert_eq!(names(one), names(other));
    for ((name, one), (_, other)) in one.iter().zip(other) {
        assert!(one == other, "{} differs", name.display());
    }
}

pub fn files_below(folder: &Path) -> Vec<PathBuf> {
    let entries = WalkDir::new(folder).into_iter();
    let paths = entries.map(|entry| entry.unwrap().into_path());
    let mut files: Vec<PathBuf> = paths.filter(|path| !path.is_dir()).collect();
    files.sort();
    files
}

/// Makes a FIFO.
pub fn make_fifo(path: &Path) {
    let status = Command::new("mkfifo").arg(path).status();
    assert!(status.unwrap().success());
}

/// Splits a command line without quotes into words.
pub fn split(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// Returns the words of a command that renders and measures very quickly.
pub fn quick_command<'a>(command: &'a str, samples_per_pixel: &'a str) -> Vec<&'a str> {
    let words = split("--quiet --out out --size 64x32 --samples-per-pixel");
    [&[command], &words[..], &[samples_per_pixel]].concat()
}

/// Returns a Python with these packages. `make test` installs them and names it in PYTHON.
pub fn python_with(packages: &[&str]) -> String {
    let python = std::env::var("PYTHON").unwrap_or("python3".to_owned());
    // Finding them is faster than importing them.
    let find = "import sys; from importlib.util import find_spec; \
        sys.exit(any(not find_spec(name) for name in sys.argv[1:]))";
    let mut command = Command::new(&python);
    let output = command.args(["-c", find]).args(packages).output();
    let is_there = output.is_ok_and(|output| output.status.success());
    let way_out = "`make test` installs them; or pip install them, and set PYTHON to the Python that has them";
    assert!(is_there, "{python} lacks one of {packages:?}: {way_out}");
    python
}
