//! `import` of a folder of OBJ files, one per frame.

use scene::load_scene;
use tests::near::assert_near;

use crate::sandbox::Sandbox;

const IMPORT: &str = "engine import wave --out scenes/wave";

/// Writes files of a triangle that grows upwards, by the square of its number.
fn write_wave(sandbox: &Sandbox, numbers: &[u32]) {
    for number in numbers {
        let height = 1.0 + 0.1 * f64::from(number * number);
        let text = format!("v -1 0 0\nv 1 0 0\nv 0 {height} 0\nf 1 2 3\n");
        sandbox.put(&format!("wave/wave_{number:04}.obj"), text);
    }
}

#[test]
fn files_of_a_folder_are_the_shapes_of_whole_frames() {
    let sandbox = Sandbox::new();
    write_wave(&sandbox, &[1, 2, 3, 4, 5]);
    let said = sandbox.done(IMPORT);
    assert!(
        said.contains("5 key shapes, one per frame; the frame is wave_0003.obj"),
        "{said}"
    );
    let scene = load_scene(sandbox.path("scenes/wave"), None).unwrap();
    let object = scene
        .objects
        .iter()
        .find(|object| object.name == "model")
        .unwrap();
    let mesh = &scene.meshes[object.mesh];
    let heights = [
        (-2.0, 1.1),
        (-1.0, 1.4),
        (-0.5, 1.65),
        (0.0, 1.9),
        (2.0, 3.5),
    ];
    for (time, height) in heights {
        assert_near(mesh.at(time).position(2).y, height, 1e-6);
    }
}

#[test]
fn a_sequence_lies_in_the_middle_of_the_files() {
    let sandbox = Sandbox::new();
    write_wave(&sandbox, &[1, 2, 3, 4, 5, 6, 7, 8]);
    let said = sandbox.done(&format!("{IMPORT} --frames 4 --plain"));
    assert!(said.contains("the frame is wave_0003.obj"), "{said}");
}

#[test]
fn folders_that_are_no_series_are_refused_with_the_way_out() {
    let sandbox = Sandbox::new();
    write_wave(&sandbox, &[1]);
    sandbox.refuse(IMPORT, &["wave: holds 1 OBJ files", "wave_0001.obj"]);
    write_wave(&sandbox, &[3]);
    sandbox.refuse(
        IMPORT,
        &["wave_0003.obj: comes after wave_0001.obj", "consecutive"],
    );
    write_wave(&sandbox, &[2]);
    sandbox.put(
        "wave/wave_0002.obj",
        "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n",
    );
    sandbox.refuse(
        IMPORT,
        &["wave_0002.obj", "the same faces in the same order"],
    );
    sandbox.put("wave/other.obj", "");
    sandbox.refuse(IMPORT, &["other.obj: has no number at the end of its name"]);
}
