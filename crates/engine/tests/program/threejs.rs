//! three.js, a real engine: its vectors against the tracer's, its blur, and what it draws of files
//! that the import reads. `make prove` installs node.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use filters::Convention;
use frame::{ExrFile, FAR_DEPTH, Frame, Image, Plane, Raster, Truth, Vectors, write_exr};
use tests::text::assert_contains;
use tests::{root, scenes};

use super::export_gltf;
use super::import_gltf::model::{MODEL, Model};
use super::import_gltf::skinned;
use super::ingest::capture::{HEIGHT, WIDTH, render_instant};
use crate::sandbox::{Sandbox, split, stderr, stdout};

/// Number of pictures over the shutter.
const SUBFRAMES: usize = 4;

/// Copies the example to the target folder, and installs three.js there unless it is installed.
pub fn install() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("threejs");
        fs::create_dir_all(&folder).unwrap();
        let lock = |folder: &Path| fs::read(folder.join("package-lock.json")).ok();
        let example = root().join("engines/threejs");
        let is_installed = lock(&folder) == lock(&example)
            && folder.join("node_modules/.package-lock.json").is_file();
        for entry in fs::read_dir(example).unwrap().map(Result::unwrap) {
            if entry.file_type().unwrap().is_file() {
                fs::copy(entry.path(), folder.join(entry.file_name())).unwrap();
            }
        }
        if !is_installed {
            run_npm(&folder, &["ci", "--no-audit", "--no-fund"]);
        }
        folder
    })
}

fn run_npm(folder: &Path, words: &[&str]) {
    let mut command = Command::new("npm");
    let output = command.current_dir(folder).args(words).output();
    let output = output.unwrap_or_else(|error| {
        panic!("npm does not start ({error}): apt-get install nodejs npm, as `make prove` does")
    });
    let said = stdout(&output) + &stderr(&output);
    assert!(output.status.success(), "npm: {said}");
}

/// Draws an exported scene with three.js, to the folder `capture`.
fn capture(sandbox: &Sandbox, exported: &str, options: &[&str]) {
    let [gltf, out] = [exported, "capture"].map(|below| sandbox.path(below).display().to_string());
    let [size, subframes] = [format!("{WIDTH}x{HEIGHT}"), SUBFRAMES.to_string()];
    let words = ["run", "-s", "capture", "--", &gltf, "--size", &size];
    let more = ["--subframes", &subframes, "--out", &out];
    run_npm(install(), &[&words[..], &more, options].concat());
}

/// A scene as drawn by three.js, and as rendered by the tracer.
struct Drawn {
    sandbox: Sandbox,
    frame: Frame,
}

impl Drawn {
    fn new(scene: &str) -> Self {
        let sandbox = Sandbox::new();
        let exported = export_gltf(&sandbox, scene, &[]);
        let frame = render_instant(scenes().join(scene), 8, 0.0);
        capture(&sandbox, &exported, &[]);
        Self { sandbox, frame }
    }

    fn file(&self, name: &str) -> frame::ExrFile {
        let file = frame::read_exr(&self.sandbox.path("capture").join(name)).unwrap();
        let is_finite = file.channels.iter().all(|channel| {
            let plane = file.plane(&channel.name).unwrap();
            assert!(plane.same_size(&self.frame.color), "size of {name}");
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

    /// Reads three.js's velocity: a picture's height and width are 2, and y points up.
    fn velocity(&self) -> Vectors {
        let file = self.file("velocity.exr");
        let [x, y] = ["velocity.X", "velocity.Y"].map(|name| file.plane(name).unwrap());
        x.zip(&y, |x, y| [*x, *y])
    }

    fn depth(&self) -> Plane {
        let depth = self.file("depth.exr").plane("Z").unwrap();
        self.convention().restore_depth(&depth).unwrap()
    }

    /// Audits the capture; returns the exit code and the output.
    fn audit(&self) -> (Option<i32>, String) {
        let folder = scenes().display().to_string();
        let words = split("engine audit capture --out audit --scenes-dir");
        let output = (self.sandbox).shuttertruth(&[&words[..], &[&folder]].concat());
        (output.status.code(), stdout(&output) + &stderr(&output))
    }

    fn change_velocity(&self, change: Change) {
        let changed = self.velocity().map(|velocity| change(*velocity));
        let mut file = ExrFile::new(WIDTH, HEIGHT);
        file.push_plane("velocity.X", &changed.map(|velocity| velocity[0]));
        file.push_plane("velocity.Y", &changed.map(|velocity| velocity[1]));
        write_exr(&self.sandbox.path("capture/velocity.exr"), &file).unwrap();
    }

    /// Returns a per-pixel measure at the pixels of some objects where both programs show the same
    /// one.
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
        let difference = |actual: &[f32; 2], expected: &[f32; 2]| {
            (actual[0] - expected[0]).hypot(actual[1] - expected[1])
        };
        let exposure = self.frame.exposure;
        let restored = self
            .convention()
            .restore_velocity(&self.velocity(), exposure)
            .unwrap();
        restored.zip(&self.frame.velocity, difference)
    }
}

/// Defect of velocity.
type Change = fn([f32; 2]) -> [f32; 2];

fn median(sorted: &[f32]) -> f32 {
    sorted[sorted.len() / 2]
}

#[test]
#[ignore = "prove: a scene in Chromium"]
fn three_js_s_objects_have_exact_vectors_which_the_audit_tells_from_planted_ones() {
    let drawn = Drawn::new("flat_field");
    let is_object = |id| id > 0;
    let speed = drawn.frame.velocity.map(|[x, y]| x.hypot(*y));
    assert!(drawn.measure(is_object, &speed).last().unwrap() > &9.0);
    let error = drawn.measure(|id| id > 1, &drawn.velocity_error());
    // A mirrored, swapped or scaled axis makes an error of pixels. SwiftShader, on machines without
    // Mesa, puts corners on a 1/16 pixel grid.
    assert!(median(&error) < 0.02, "{} px", median(&error));
    assert!(error[error.len() * 95 / 100] < 0.1);
    let depth = drawn.depth();
    let error = depth.zip(&drawn.frame.depth, |actual, expected| {
        (actual / expected - 1.0).abs()
    });
    assert!(median(&drawn.measure(is_object, &error)) < 1e-3);

    // Everything emits 0.5; the sum of 16 taps and the pixel itself is divided by 16.
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
    let told = (drawn.sandbox).done("engine ingest capture --out engine");
    assert_contains(&told, &["makes the picture brighter, 1.0625 times"]);

    let (code, said) = drawn.audit();
    assert_eq!(code, Some(0), "{said}");
    let right = fs::read(drawn.sandbox.path("capture/velocity.exr")).unwrap();
    let planted: [(Change, &str); 4] = [
        (|[x, y]| [2.0 * x, 2.0 * y], "velocity is twice too long"),
        (|[x, y]| [x, -y], "velocity has y flipped"),
        (|_| [0.0; 2], "velocity is zero"),
        (
            |[x, y]| [x + 0.01, y + 0.01],
            "velocity is off by (+0.480, -0.270) px",
        ),
    ];
    for (change, cause) in planted {
        drawn.change_velocity(change);
        let (code, said) = drawn.audit();
        assert_eq!(code, Some(1), "{cause}: {said}");
        assert_contains(&said, &[cause]);
        fs::write(drawn.sandbox.path("capture/velocity.exr"), &right).unwrap();
    }
}

#[test]
#[ignore = "prove: a second scene in Chromium"]
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
    let [actual, expected] = [&drawn.depth(), &drawn.frame.depth].map(|depth| {
        let depths = depth.pixels.iter();
        depths.filter(|depth| **depth == FAR_DEPTH).count()
    });
    assert!(actual.abs_diff(expected) < 50, "{actual} {expected}");
}

#[test]
#[ignore = "prove: two files in Chromium"]
fn three_js_draws_the_colours_vectors_and_blur_that_the_import_of_a_gltf_file_has() {
    for (model, seconds, rate) in [(skinned(1), "1", "1"), (Model::sliding(), "1", "4")] {
        let sandbox = Sandbox::new();
        model.write(&sandbox);
        let line = format!("engine import {MODEL} --time {seconds}s --fps {rate}");
        sandbox.done(&format!("{line} --out scenes/imported"));
        sandbox.done("engine export imported@unlit --gltf gltf");
        let original = sandbox.path(MODEL).display().to_string();
        let options = ["--original", &original, "--at", seconds, "--fps", rate];
        capture(&sandbox, "gltf/imported@unlit", &options);
        let told = sandbox.done("engine audit capture");
        assert_contains(&told, &["PASS: velocity, depth and colour are right"]);

        let size = format!("{WIDTH}x{HEIGHT}");
        let render = "truths render imported@unlit --alignments centred --samples-per-pixel 64";
        sandbox.done(&format!("{render} --size {size} --out truths"));
        let truth = Truth::read(&sandbox.path("truths/imported@unlit/truth_centred.exr")).unwrap();
        let subframes: Vec<Image> = (0..SUBFRAMES)
            .map(|at| sandbox.path(&format!("capture/subframes/{at:04}.exr")))
            .map(|path| frame::read_exr(&path).unwrap().color("").unwrap())
            .collect();
        let difference = mean_difference(&subframes, &truth.mean().color);
        // Both sample edges: measured 1.8e-4. A shutter twice as long is 2.9e-4 and 3.9e-4 off.
        assert!(difference < 2.5e-4, "{difference}");
    }
}

/// Returns the mean absolute difference between the mean of pictures and another.
fn mean_difference(pictures: &[Image], other: &Image) -> f64 {
    let pixels = other.pixels.iter().enumerate();
    let differences = pixels.flat_map(|(at, pixel)| {
        (0..3).map(move |channel| {
            let mine = pictures.iter().map(|picture| picture.pixels[at][channel]);
            f64::from((mine.sum::<f32>() / pictures.len() as f32 - pixel[channel]).abs())
        })
    });
    differences.sum::<f64>() / (3 * other.pixels.len()) as f64
}
