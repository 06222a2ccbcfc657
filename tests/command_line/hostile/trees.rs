//! Geometry that a tree cannot split, and renders that do not fit into memory.

use std::process::Output;
use std::time::{Duration, Instant};

use crate::sandbox::{OBJ, SCENE, Sandbox, assert_done, assert_refused, files_below, stderr};

/// Time limit for a second or two of work on a busy machine. These cases once took longer, or ended the program.
const PATIENCE: Duration = Duration::from_secs(60);

/// Renders the plate with these faces after its own two.
fn render(sandbox: &Sandbox, more_faces: &str) -> Output {
    sandbox.write("plate.obj", &format!("{OBJ}{more_faces}"));
    render_soon(sandbox, &[])
}

/// Renders the scene, and fails if that takes long.
fn render_soon(sandbox: &Sandbox, more: &[&str]) -> Output {
    let words = [
        "truths", "render", "--quiet", "--out", "out", "--size", "16x16",
    ];
    let samples = ["--scenes", "plate", "--samples-per-pixel", "16"];
    let began = Instant::now();
    let output = sandbox.shuttertruth(&[&words[..], &samples, more].concat());
    assert!(began.elapsed() < PATIENCE, "{:?}", began.elapsed());
    output
}

/// Reads the channels of all pictures of a render.
fn pictures(sandbox: &Sandbox) -> Vec<Vec<frame::Channel>> {
    let files = files_below(&sandbox.path("out")).into_iter();
    files
        .filter(|file| file.extension().is_some_and(|kind| kind == "exr"))
        .map(|path| frame::read_exr(&path).unwrap().channels)
        .collect()
}

/// Writes triangles of these corners as statements of an OBJ file.
fn triangles(corners: impl Iterator<Item = [[f64; 3]; 3]>) -> String {
    corners
        .map(|corners| {
            let vertices = corners.map(|[x, y, z]| format!("v {x:e} {y:e} {z:e}\n"));
            vertices.concat() + "f -3 -2 -1\n"
        })
        .collect()
}

#[test]
fn copies_of_a_face_are_dropped_with_a_note_and_change_no_pixel() {
    let (plain, crowded) = (Sandbox::new(), Sandbox::new());
    assert_done(&render(&plain, ""));
    // The plate emits light, and so does every copy.
    let output = render(&crowded, &"f 1 2 3\n".repeat(20_000));
    assert_done(&output);
    let note = "20000 of 20002 triangles of object plate are copies of others; they are left out";
    assert!(stderr(&output).contains(note), "{}", stderr(&output));
    let pictures = [&plain, &crowded].map(pictures);
    assert!(pictures[0].len() > 8);
    assert!(pictures[0] == pictures[1]);
}

#[test]
fn faces_without_area_are_dropped_with_a_note_and_change_no_pixel() {
    let (plain, crowded) = (Sandbox::new(), Sandbox::new());
    assert_done(&render(&plain, ""));
    let on_a_line =
        (0..20_000).map(|x| [0, 1, 3].map(|step| [f64::from(x + step) * 1e-5, 0.0, 0.0]));
    let output = render(&crowded, &triangles(on_a_line));
    assert_done(&output);
    let note = "20000 of 20002 triangles of object plate have no area; they are left out";
    assert!(stderr(&output).contains(note), "{}", stderr(&output));
    assert!(pictures(&plain) == pictures(&crowded));
}

#[test]
fn many_different_faces_in_one_place_are_refused() {
    let sandbox = Sandbox::new();
    // Each has its own texture coordinates.
    let faces: String = (0..300)
        .map(|u| format!("vt {u} 0\nf 1/-1 2/-1 3/-1\n"))
        .collect();
    sandbox.write(
        "plate.obj",
        &(OBJ.replace("f 1 2 3\nf 1 3 4\n", "") + &faces),
    );
    let parts = [
        "plate.obj",
        "object plate",
        "allowed: 256",
        "delete all but one",
    ];
    assert_refused(&render_soon(&sandbox, &[]), 2, &parts);
}

#[test]
fn a_few_faces_in_one_place_render_the_same_every_time() {
    let sandbox = Sandbox::new();
    assert_done(&render(&sandbox, "f 3 2 1\nf 2 3 1\nf 1 3 2\n"));
    let first = pictures(&sandbox);
    std::fs::remove_dir_all(sandbox.path("out")).unwrap();
    assert_done(&render_soon(&sandbox, &["--threads", "1"]));
    assert!(first == pictures(&sandbox));
}

#[test]
fn nested_faces_render() {
    // Each face is larger than the one before, about one centre, so that its box contains all the others'.
    let nested = (1..=6000).map(|size| {
        let size = f64::from(size) * 1e-5;
        [[-size, -size, 0.0], [size, -size, 0.0], [0.0, size, 0.0]]
    });
    assert_done(&render(&Sandbox::new(), &triangles(nested)));
}

#[test]
fn long_thin_crossing_faces_render() {
    // Fractional parts of multiples of irrational numbers spread evenly.
    let part = |number: u32, step: f64| 20.0 * (f64::from(number) * step).fract() - 10.0;
    let thin = (0..2000).map(|number| {
        let [from, to] = [number, number + 5000]
            .map(|number| [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step| part(number, step)));
        [from, to, to.map(|coordinate| coordinate + 1e-3)]
    });
    assert_done(&render(&Sandbox::new(), &triangles(thin)));
}

#[test]
fn many_objects_in_one_place_render() {
    let sandbox = Sandbox::new();
    let (head, object) = SCENE.split_once("[object.plate]").unwrap();
    let objects: String = (0..1000)
        .map(|index| format!("[object.plate_{index}]{object}"))
        .collect();
    sandbox.write("scene.toml", &format!("{head}{objects}"));
    assert_done(&render_soon(&sandbox, &[]));
}

#[test]
fn geometry_that_is_too_large_is_refused() {
    let sandbox = Sandbox::new();
    let size = 1e30;
    let huge = [[-size, 0.0, -1.0], [size, 0.0, -1.0], [0.0, size, -1.0]];
    let output = render(&sandbox, &triangles([huge].into_iter()));
    assert_refused(&output, 2, &["plate"]);
    assert!(!sandbox.path("out/plate/frame.exr").exists());
}

#[test]
fn a_picture_that_is_not_finite_is_refused_before_it_is_written() {
    let sandbox = Sandbox::new();
    // The sum of two such radiances exceeds what a float holds.
    sandbox.write(
        "plate.mtl",
        "newmtl paint\nKd 0.5 0.5 0.5\nKe 3e38 3e38 3e38\n",
    );
    assert_refused(&render_soon(&sandbox, &[]), 2, &["plate"]);
    assert!(!sandbox.path("out/plate/frame.exr").exists());
}

#[test]
fn samples_and_threads_beyond_the_limits_are_refused() {
    let sandbox = Sandbox::new();
    let refused = |words: &[&str], part: &str| {
        let words = [
            &[
                "truths", "render", "--quiet", "--out", "out", "--scenes", "plate",
            ],
            words,
        ]
        .concat();
        assert_refused(&sandbox.shuttertruth(&words), 2, &[part]);
        assert!(!sandbox.path("out").exists());
    };
    refused(
        &["--samples-per-pixel", "4294967295"],
        "'4294967295' for '--samples-per-pixel <N>': allowed: 8 times a power of two",
    );
    refused(&["--samples-per-pixel", "131072"], "such as 65536");
    refused(
        &["--threads", "100000"],
        "'100000' for '--threads <N>': 100000 is not in 1..=1024",
    );
    refused(&["--threads", "0"], "0 is not in 1..=1024");
    refused(&["--size", "1000000x1000000"], "16384");
}

#[cfg(target_os = "linux")]
#[test]
fn a_render_that_exceeds_memory_is_refused_before_it_begins() {
    let sandbox = Sandbox::new();
    let limited = |size: &str| {
        let program = env!("CARGO_BIN_EXE_shuttertruth");
        let words =
            "truths render --quiet --out out --scenes plate --samples-per-pixel 16 --threads 1";
        let script = format!("ulimit -v 1258291 && exec {program} {words} --size {size}");
        let mut shell = std::process::Command::new("sh");
        shell.current_dir(sandbox.path("")).args(["-c", &script]);
        shell.output().unwrap()
    };
    let began = Instant::now();
    let parts = [
        "scene plate: needs about 16.",
        "GiB for 4096x4096",
        "are free",
        "smaller size",
    ];
    assert_refused(&limited("4096x4096"), 2, &parts);
    assert!(
        began.elapsed() < Duration::from_secs(20),
        "before it begins"
    );
    assert_done(&limited("64x32"));
}
