//! Geometry that a tree cannot split, and renders that exceed memory.

use std::path::PathBuf;
use std::process::Output;
use std::time::{Duration, Instant};

use crate::sandbox::*;

/// Renders the scene, and fails if that takes long. These cases once took longer, or ended the program.
fn render(sandbox: &Sandbox, more: &str) -> Output {
    let words =
        "truths render --quiet --out out --size 16x16 --scenes plate --samples-per-pixel 16";
    let began = Instant::now();
    let output = sandbox.shuttertruth(&split(&format!("{words} {more}")));
    // A second or two of work, on a busy machine.
    assert!(began.elapsed() < Duration::from_secs(60));
    output
}

/// Makes a sandbox whose plate has more faces.
fn with_faces(more: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("plate.obj", &format!("{OBJ}{more}"));
    sandbox
}

/// Reads the channels of all pictures of a render.
fn pictures(sandbox: &Sandbox) -> Vec<Vec<frame::Channel>> {
    let mut files = files_below(&sandbox.path("out"));
    files.retain(|file| file.extension().is_some_and(|kind| kind == "exr"));
    let channels = |path: &PathBuf| frame::read_exr(path).unwrap().channels;
    files.iter().map(channels).collect()
}

/// Writes triangles of these corners as statements of an OBJ file.
fn triangles(corners: impl Iterator<Item = [[f64; 3]; 3]>) -> String {
    let vertex = |[x, y, z]: [f64; 3]| format!("v {x:e} {y:e} {z:e}\n");
    let faces = corners.map(|corners| corners.map(vertex).concat() + "f -3 -2 -1\n");
    faces.collect()
}

#[test]
fn useless_faces_are_dropped_with_a_note_and_change_no_pixel() {
    let plain = Sandbox::new();
    assert_done(&render(&plain, ""));
    let plain = pictures(&plain);
    assert!(plain.len() > 8);
    // The plate emits light, and so does every copy.
    let copies = "f 1 2 3\n".repeat(20_000);
    let on_a_line =
        (0..20_000).map(|x| [0, 1, 3].map(|step| [f64::from(x + step) * 1e-5, 0.0, 0.0]));
    for (faces, what) in [
        (copies, "are copies of others"),
        (triangles(on_a_line), "have no area"),
    ] {
        let crowded = with_faces(&faces);
        let output = render(&crowded, "");
        assert_done(&output);
        let note = format!("20000 of 20002 triangles of object plate {what}; they are left out");
        assert!(stderr(&output).contains(&note), "{}", stderr(&output));
        assert!(plain == pictures(&crowded), "{what}");
    }
}

#[test]
fn a_few_faces_in_one_place_render_the_same_every_time() {
    let sandbox = with_faces("f 3 2 1\nf 2 3 1\nf 1 3 2\n");
    assert_done(&render(&sandbox, ""));
    let first = pictures(&sandbox);
    std::fs::remove_dir_all(sandbox.path("out")).unwrap();
    assert_done(&render(&sandbox, "--threads 1"));
    assert!(first == pictures(&sandbox));
}

#[test]
fn geometry_that_is_hard_to_split_renders() {
    // Each face is larger than the previous one, about one centre, so that its box contains all the others'.
    let nested = (1..=6000).map(|size| {
        let size = f64::from(size) * 1e-5;
        [[-size, -size, 0.0], [size, -size, 0.0], [0.0, size, 0.0]]
    });
    // Long, thin and crossing. Fractional parts of multiples of irrational numbers spread evenly.
    let part = |number: u32, step: f64| 20.0 * (f64::from(number) * step).fract() - 10.0;
    let thin = (0..2000).map(|number| {
        let [from, to] = [number, number + 5000]
            .map(|number| [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step| part(number, step)));
        [from, to, to.map(|coordinate| coordinate + 1e-3)]
    });
    let (nested, thin) = (with_faces(&triangles(nested)), with_faces(&triangles(thin)));
    // Many objects in one place.
    let crowd = Sandbox::new();
    let (head, object) = SCENE.split_once("[object.plate]").unwrap();
    let named = |index| format!("[object.plate_{index}]{object}");
    let objects: String = (0..1000).map(named).collect();
    crowd.write("scene.toml", &format!("{head}{objects}"));
    for sandbox in [nested, thin, crowd] {
        assert_done(&render(&sandbox, ""));
    }
}

#[test]
fn geometry_and_light_beyond_the_limits_are_refused_before_a_picture_is_written() {
    // Faces in one place, each with its own texture coordinates.
    let faces = (0..300).map(|u| format!("vt {u} 0\nf 1/-1 2/-1 3/-1\n"));
    let one_place = OBJ.replace("f 1 2 3\nf 1 3 4\n", "") + &faces.collect::<String>();
    let size = 1e30;
    let huge = [[-size, 0.0, -1.0], [size, 0.0, -1.0], [0.0, size, -1.0]];
    let huge = format!("{OBJ}{}", triangles([huge].into_iter()));
    // The sum of two such radiances overflows a float.
    let bright = "newmtl paint\nKd 0.5 0.5 0.5\nKe 3e38 3e38 3e38\n".to_owned();
    let parts = "plate.obj | object plate | allowed: 256 | delete all but one";
    for (file, text, parts) in [
        ("plate.obj", one_place, parts),
        ("plate.obj", huge, "plate"),
        ("plate.mtl", bright, "plate"),
    ] {
        let sandbox = Sandbox::new();
        sandbox.write(file, &text);
        assert_refused(&render(&sandbox, ""), 2, parts);
        assert!(!sandbox.path("out/plate/frame.exr").exists());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_render_that_exceeds_memory_is_refused_before_it_begins() {
    let sandbox = Sandbox::new();
    let limited = |size: &str| {
        let program = env!("CARGO_BIN_EXE_shuttertruth");
        let words = "truths render --quiet --out out --samples-per-pixel 16 --threads 1";
        let script = format!("ulimit -v 1258291 && exec {program} {words} --size {size}");
        let mut shell = std::process::Command::new("sh");
        shell.current_dir(sandbox.path("")).args(["-c", &script]);
        shell.output().unwrap()
    };
    let began = Instant::now();
    let needs = "scene plate: needs about 16.";
    let parts = [needs, "GiB for 4096x4096", "are free", "smaller size"];
    assert_refused(&limited("4096x4096"), 2, &parts);
    let took = began.elapsed();
    assert!(took < Duration::from_secs(20), "{took:?}");
    assert_done(&limited("64x32"));
}
