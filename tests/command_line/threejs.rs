//! three.js, a real engine: its vectors against the tracer's, and its blur. `make test` installs node.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use filters::Convention;
use frame::{FAR_DEPTH, Frame, Image, Plane, Raster, Vectors};
use tests::text::assert_contains;
use tests::{root, scenes};

use crate::sandbox::{Sandbox, split, stderr, stdout};

/// Number of pictures over the shutter.
const SUBFRAMES: usize = 4;
const SIZE: &str = "96x54";

/// Copies the example to the target folder, and installs three.js there unless it is installed.
fn install() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("threejs");
        fs::create_dir_all(&folder).unwrap();
        let lock = |folder: &Path| fs::read(folder.join("package-lock.json")).ok();
        let example = root().join("examples/threejs");
        let is_installed = lock(&folder) == lock(&example)
            && folder.join("node_modules/.package-lock.json").is_file();
        copy_files(&example, &folder);
        if !is_installed {
            run_npm(&folder, ["ci", "--no-audit", "--no-fund"]);
        }
        folder
    })
}

/// Copies the example with one change of how it draws.
fn plant(old: &str, new: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    copy_files(install(), folder.path());
    let modules = "node_modules";
    std::os::unix::fs::symlink(install().join(modules), folder.path().join(modules)).unwrap();
    let path = folder.path().join("draw.js");
    let text = fs::read_to_string(&path).unwrap();
    assert_eq!(text.matches(old).count(), 1, "draw.js has not one {old}");
    fs::write(&path, text.replace(old, new)).unwrap();
    folder
}

fn copy_files(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
        if entry.file_type().unwrap().is_file() {
            fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
        }
    }
}

fn run_npm<S: AsRef<OsStr>>(folder: &Path, words: impl IntoIterator<Item = S>) {
    let mut command = Command::new("npm");
    let output = command.current_dir(folder).args(words).output();
    let output = output.unwrap_or_else(|error| {
        panic!("npm does not start ({error}): apt-get install nodejs npm, as `make test` does")
    });
    let said = [output.stdout, output.stderr].map(|said| String::from_utf8(said).unwrap());
    assert!(output.status.success(), "npm: {}", said.join("\n"));
}

/// A scene as three.js draws it, and as the tracer renders it.
struct Drawn {
    sandbox: Sandbox,
    frame: Frame,
}

impl Drawn {
    fn new(scene: &str) -> Self {
        let sandbox = Sandbox::new();
        let folder = scenes().display().to_string();
        let words = split("engine export --gltf gltf --scenes-dir");
        sandbox.execute(&[&words, &[&folder, scene][..]].concat());
        let words =
            split("truths render --quiet --samples-per-pixel 8 --velocity previous_frame --out r");
        let scene_words = ["--scenes-dir", &folder, "--scenes", scene, "--size", SIZE];
        sandbox.execute(&[&words, &scene_words[..]].concat());
        let frame = Frame::read(&sandbox.path("r").join(scene).join("frame.exr")).unwrap();
        let drawn = Self { sandbox, frame };
        drawn.capture(install());
        drawn
    }

    /// Lets three.js draw the scene, in place of what it drew before.
    fn capture(&self, example: &Path) {
        let mut words: Vec<String> = ["run", "-s", "capture", "--"].map(str::to_owned).into();
        let gltf = self.sandbox.path("gltf").join(&self.frame.provenance.scene);
        words.push(gltf.display().to_string());
        words.extend(["--size".to_owned(), SIZE.to_owned()]);
        words.extend(["--subframes".to_owned(), SUBFRAMES.to_string()]);
        let out = self.sandbox.path("capture");
        words.extend(["--out".to_owned(), out.display().to_string()]);
        run_npm(example, words);
    }

    fn file(&self, name: &str) -> frame::ExrFile {
        let file = frame::read_exr(&self.sandbox.path("capture").join(name)).unwrap();
        let is_finite = file.channels.iter().all(|channel| {
            let plane = file.plane(&channel.name).unwrap();
            assert!(
                plane.same_size(&self.frame.color),
                "{name} has another size"
            );
            plane.pixels.iter().all(|value| value.is_finite())
        });
        assert!(is_finite, "{name} holds NaN or infinity");
        file
    }

    fn color(&self, name: &str) -> Image {
        self.file(name).color("").unwrap()
    }

    fn convention(&self) -> Convention {
        let path = self.sandbox.path("capture/engine.toml");
        Convention::parse(&path, &fs::read_to_string(&path).unwrap()).unwrap()
    }

    fn velocity(&self) -> Vectors {
        let file = self.file("velocity.exr");
        let [x, y] = ["velocity.X", "velocity.Y"].map(|name| file.plane(name).unwrap());
        let velocity = x.zip(&y, |x, y| [*x, *y]);
        (self.convention()).restore_velocity(&velocity, self.frame.exposure)
    }

    fn depth(&self) -> Plane {
        self.convention()
            .restore_depth(&self.file("depth.exr").plane("Z").unwrap())
    }

    /// Audits the capture; returns the exit code and what is printed.
    fn audit(&self) -> (Option<i32>, String) {
        let folder = scenes().display().to_string();
        let words = split("engine audit capture --out audit --scenes-dir");
        let output = self
            .sandbox
            .shuttertruth(&[&words, &[folder.as_str()][..]].concat());
        (output.status.code(), stdout(&output) + &stderr(&output))
    }

    /// Returns what a measure of every pixel is at the pixels of some objects where both programs see the same one.
    fn measure(&self, of: impl Fn(u32) -> bool, measure: &Raster<f32>) -> Vec<f32> {
        let ids = self.file("object.exr").plane("object").unwrap();
        let expected = &self.frame.object_id.pixels;
        let both = ids.pixels.iter().zip(expected).zip(&measure.pixels);
        let here = both.filter(|((id, expected), _)| **id == **expected as f32 && of(**expected));
        let mut measured: Vec<f32> = here.map(|(_, value)| *value).collect();
        measured.sort_by(f32::total_cmp);
        assert!(measured.len() > 100, "only {} pixels", measured.len());
        measured
    }

    /// Returns the length of the difference between both velocities.
    fn velocity_error(&self) -> Raster<f32> {
        let difference = |own: &[f32; 2], expected: &[f32; 2]| {
            (own[0] - expected[0]).hypot(own[1] - expected[1])
        };
        self.velocity().zip(&self.frame.velocity, difference)
    }
}

fn median(sorted: &[f32]) -> f32 {
    sorted[sorted.len() / 2]
}

#[test]
fn three_js_s_objects_have_exact_vectors_and_its_blur_adds_a_sixteenth() {
    let drawn = Drawn::new("flat_field");
    let is_object = |id| id > 0;
    let speed = drawn.frame.velocity.map(|[x, y]| x.hypot(*y));
    assert!(drawn.measure(is_object, &speed).last().unwrap() > &9.0);
    let error = drawn.measure(|id| id > 1, &drawn.velocity_error());
    // A mirrored, swapped or scaled axis makes pixels. SwiftShader, on machines without Mesa, puts corners on a grid of 1/16 pixel.
    assert!(median(&error) < 0.02, "{} px", median(&error));
    assert!(error[error.len() * 95 / 100] < 0.1);
    let depth = drawn.depth();
    let error = depth.zip(&drawn.frame.depth, |own, expected| {
        (own / expected - 1.0).abs()
    });
    assert!(median(&drawn.measure(is_object, &error)) < 1e-3);

    // Everything sends 0.5; 16 taps and the pixel itself are divided by 16.
    let color = drawn.color("color.exr");
    let blurred = drawn.color("blurred.exr");
    for (name, picture, expected) in [("color", color, 0.5), ("blurred", blurred, 0.53125)] {
        let values = picture.pixels.iter().flatten();
        let off = values.fold(0.0f32, |off, value| off.max((value - expected).abs()));
        assert!(off < 1e-5, "{name} is {off} off {expected}");
    }
    for at in 0..SUBFRAMES {
        let picture = drawn.color(&format!("subframes/{at:04}.exr"));
        assert_eq!(picture.pixels[0], [0.5; 3]);
    }
}

#[test]
fn three_js_gives_the_sky_the_motion_of_something_near() {
    let drawn = Drawn::new("pan_sky");
    let error = drawn.velocity_error();
    let towers = drawn.measure(|id| id > 0, &error);
    assert!(median(&towers) < 0.02, "{} px", median(&towers));
    let sky = drawn.measure(|id| id == 0, &error);
    assert!(median(&sky) > 5.0, "{} px", median(&sky));
    let (code, said) = drawn.audit();
    assert_eq!(code, Some(1), "{said}");
    assert_contains(&said, &["velocity of `background`"]);
    assert!(!said.contains("velocity of `skyline`"), "{said}");
    let nothing = drawn
        .frame
        .depth
        .pixels
        .iter()
        .filter(|depth| **depth == FAR_DEPTH);
    let own = drawn.depth();
    let own = own.pixels.iter().filter(|depth| **depth == FAR_DEPTH);
    assert!(nothing.count().abs_diff(own.count()) < 50);
}

#[test]
fn audit_names_what_is_planted_in_three_js_s_velocity() {
    let drawn = Drawn::new("flat_field");
    let (code, said) = drawn.audit();
    assert_eq!(code, Some(0), "{said}");
    let told = (drawn.sandbox).execute(&["engine", "ingest", "capture", "--out", "engine"]);
    assert_contains(&told, &["makes the picture brighter, 1.0625 times"]);
    for (planted, cause) in [
        ("velocity.mul(2)", "velocity is twice too long"),
        ("velocity.mul(vec2(1, -1))", "velocity has y flipped"),
        ("vec2(0)", "velocity is zero"),
        (
            "velocity.add(vec2(0.01))",
            "velocity is off by (+0.480, -0.270) px",
        ),
    ] {
        let changed = format!("{{ output, velocity: {planted}, ");
        drawn.capture(plant("{ output, velocity, ", &changed).path());
        let (code, said) = drawn.audit();
        assert_eq!(code, Some(1), "{planted}: {said}");
        assert_contains(&said, &[cause]);
    }
}
