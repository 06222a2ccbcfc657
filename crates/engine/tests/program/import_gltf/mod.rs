//! `import` of glTF: small files of one rule each, with answers by hand.

mod materials;
pub mod model;
mod refusals;
mod round_trip;

use glam::DVec3;
use scene::{Scene, load_scene};
use serde_json::json;

use self::model::{MODEL, Model};
use crate::sandbox::{Sandbox, assert_done, split, stdout};

/// Imports a model; returns what was said and the scene. The frame is at 1 s and a frame takes a
/// second, unless `more` says otherwise.
fn import_with(model: &Model, more: &str) -> (String, Scene) {
    let sandbox = Sandbox::new();
    model.write(&sandbox);
    let words = ["engine", "import", MODEL, "--out", "scenes/thing"];
    let output = sandbox.shuttertruth(&[&words, &split(more)[..]].concat());
    assert_done(&output);
    let said = stdout(&output) + &String::from_utf8_lossy(&output.stderr);
    (
        said,
        load_scene(sandbox.path("scenes/thing"), None).unwrap(),
    )
}

fn import(model: &Model) -> Scene {
    import_with(model, "--time 1s --fps 1").1
}

/// Returns where a vertex of an object is in the world.
fn vertex(scene: &Scene, object: usize, vertex: u32, time: f64) -> DVec3 {
    let mesh = &scene.meshes[scene.objects[object].mesh];
    scene
        .object_to_world(object, time)
        .transform_point3(mesh.at(time).position(vertex))
}

/// Positions are rounded to 32 bits.
#[track_caller]
fn assert_at(scene: &Scene, number: u32, time: f64, expected: [f64; 3]) {
    let place = vertex(scene, 0, number, time);
    let off = place.distance(DVec3::from(expected));
    assert!(
        off < 1e-5,
        "vertex {number} at {time}: {place}, not {expected:?}"
    );
}

#[test]
fn a_linear_slide_moves_by_its_keys_and_stops_at_the_last() {
    let scene = import(&Model::sliding());
    for time in [-1.0, -0.5, 0.0, 0.25, 1.0] {
        assert_at(&scene, 1, time, [time + 2.0, 0.0, 0.0]);
    }
    // The last key is at 2 s, a frame after the instant.
    assert_at(&scene, 1, 1.5, [3.0, 0.0, 0.0]);
    assert_eq!(scene.objects[0].name, "thing");
    assert_eq!([scene.width, scene.height], [640, 320]);
    assert_eq!(vertex(&scene, 0, 0, 0.0), DVec3::X);
}

#[test]
fn frames_per_second_say_how_far_a_frame_moves() {
    let (said, scene) = import_with(&Model::sliding(), "--fps 4");
    // The middle of two seconds is the default.
    assert_at(&scene, 0, 0.0, [1.0, 0.0, 0.0]);
    assert_at(&scene, 0, -1.0, [0.75, 0.0, 0.0]);
    assert!(
        said.contains("animation \"walk\" at 1.0000 s, 4 frames per second"),
        "{said}"
    );
}

#[test]
fn a_step_jumps_at_its_key() {
    let mut model = Model::new();
    let places = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 0.0];
    model.animate(0, "translation", "STEP", &[0.0, 1.5, 2.0], &places);
    let scene = import(&model);
    for (time, x) in [
        (-1.0, 0.0),
        (0.0, 0.0),
        (0.498, 0.0),
        (0.5, 1.0),
        (0.99, 1.0),
        (1.0, 3.0),
        (2.0, 3.0),
    ] {
        assert_at(&scene, 0, time, [x, 0.0, 0.0]);
    }
}

#[test]
fn a_cubic_spline_follows_hermite_s_polynomial_to_a_tenth_of_a_pixel() {
    let mut model = Model::new();
    // Two keys 2 s apart: x from 0 with slope 2 m/s to 1 with slope 0.
    let zero = [0.0; 3];
    let values = [zero, zero, [2.0, 0.0, 0.0], zero, [1.0, 0.0, 0.0], zero].concat();
    model.animate(0, "translation", "CUBICSPLINE", &[0.0, 2.0], &values);
    let scene = import(&model);
    for time in [-1.0f64, -0.7, -0.33, 0.0, 0.4, 0.9] {
        let part = (time + 1.0) / 2.0;
        let [square, cube] = [part.powi(2), part.powi(3)];
        let x = 4.0 * (cube - 2.0 * square + part) + 3.0 * square - 2.0 * cube;
        let off = vertex(&scene, 0, 0, time).x - x;
        // 320 px high, 1 radian: a metre at 5 m is 58.6 px.
        assert!(off.abs() * 58.6 < 0.1, "{off} m at {time}");
    }
    // The velocity at the instant, in the middle: 1/2 m of 2 s in mean, and slopes.
    let [before, after] = [-1e-5, 1e-5].map(|time| vertex(&scene, 0, 0, time).x);
    let slope = (after - before) / 2e-5;
    // h'(1/2) / 2 = (4 (3/4 - 2 + 1) + 3 - 3/2) / 2 = 1/4.
    assert!((slope - 0.25).abs() * 58.6 < 0.1, "{slope}");
}

#[test]
fn animations_of_different_nodes_play_together_on_request() {
    let mut model = Model::sliding();
    let moved = [0.0, 0.0, 5.0, 0.0, 2.0, 5.0];
    model.animate(1, "translation", "LINEAR", &[0.0, 2.0], &moved);
    let channel = model.json["animations"][0]["channels"]
        .as_array_mut()
        .unwrap()
        .pop();
    let mut second = model.json["animations"][0].clone();
    second["name"] = json!("pan");
    second["channels"] = json!([channel]);
    model.push("animations", second);
    let (said, scene) = import_with(&model, "");
    assert!(
        said.contains("animation \"walk\" of \"walk\", \"pan\" is imported"),
        "{said}"
    );
    assert_eq!(scene.camera.motion.keys.len(), 1);
    let (_, scene) = import_with(&model, "--animation walk --animation pan --time 1s");
    assert_at(&scene, 0, 0.0, [1.0, 0.0, 0.0]);
    let camera = scene.camera.motion.at(0.0);
    assert!(camera.translation.distance(DVec3::new(0.0, 1.0, 5.0)) < 1e-9);
}

#[test]
fn a_child_moves_with_its_turning_parent() {
    let mut model = Model::new();
    model.json["nodes"][0] = json!({ "name": "parent", "translation": [0, 1, 0], "children": [2] });
    let child =
        json!({ "name": "thing", "mesh": 0, "translation": [1, 0, 0], "scale": [1, 1, -2] });
    assert_eq!(model.push("nodes", child), 2);
    // From 0 to 180 degrees about Y, less a little, in 2 s.
    let half = (0.5f32 * 170.0).to_radians();
    let turns = [0.0, 0.0, 0.0, 1.0, 0.0, half.sin(), 0.0, half.cos()];
    model.animate(0, "rotation", "LINEAR", &[0.0, 2.0], &turns);
    let scene = import(&model);
    for time in [-1.0, 0.0, 1.0] {
        let (sine, cosine) = (85.0 * (time + 1.0f64)).to_radians().sin_cos();
        // Vertex 1 is at (2, 0, 0) of the parent.
        assert_at(&scene, 1, time, [2.0 * cosine, 1.0, -2.0 * sine]);
    }
}

/// Adds a skin of two joints, nodes 2 and 3: the second one slides up by a metre in 2 s.
pub fn skinned(sets: usize) -> Model {
    let mut model = Model::new();
    // The node's own place does not count.
    model.json["nodes"][0] =
        json!({ "name": "thing", "mesh": 0, "skin": 0, "translation": [9, 9, 9] });
    model.push("nodes", json!({ "children": [3] }));
    model.push("nodes", json!({ "translation": [0, 0, 0] }));
    model.json["scenes"][0]["nodes"] = json!([0, 1, 2]);
    let identity = [
        1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    ];
    let mut moved = identity;
    // The second joint's bind pose is a metre to the right.
    moved[12] = -1.0;
    let inverse = model.floats("MAT4", &[identity, moved].concat());
    model.push(
        "skins",
        json!({ "joints": [2, 3], "inverseBindMatrices": inverse }),
    );
    model.animate(
        3,
        "translation",
        "LINEAR",
        &[0.0, 2.0],
        &[1.0, 0.0, 0.0, 1.0, 1.0, 0.0],
    );
    let joints = [0, 1, 0, 0].repeat(3);
    // Vertex 0 follows the first joint, vertex 1 the second, vertex 2 both.
    let weights = if sets == 1 {
        vec![1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.25, 0.75, 0.0, 0.0]
    } else {
        vec![1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.25, 0.25, 0.0, 0.0]
    };
    let joints = model.bytes("VEC4", 3, &joints);
    let weights = model.floats("VEC4", &weights);
    let attributes = &mut model.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = json!(joints);
    attributes["WEIGHTS_0"] = json!(weights);
    if sets == 2 {
        let joints = model.bytes("VEC4", 3, &[1; 12]);
        let mut more = vec![0.0; 12];
        more[8] = 0.5;
        let weights = model.floats("VEC4", &more);
        let attributes = &mut model.json["meshes"][0]["primitives"][0]["attributes"];
        attributes["JOINTS_1"] = json!(joints);
        attributes["WEIGHTS_1"] = json!(weights);
    }
    model
}

#[test]
fn vertices_follow_the_joints_of_a_skin_by_their_weights() {
    for sets in [1, 2] {
        let scene = import(&skinned(sets));
        for (time, up) in [(-1.0, 0.0), (0.0, 0.5), (1.0, 1.0)] {
            assert_at(&scene, 0, time, [0.0, 0.0, 0.0]);
            assert_at(&scene, 1, time, [1.0, up, 0.0]);
            assert_at(&scene, 2, time, [0.0, 1.0 + 0.75 * up, 0.0]);
        }
    }
}

/// Adds a morph target that moves vertex 2 by 2 m to the back, with weights from 0 to 1 in 2 s.
fn morph(model: &mut Model) {
    let target = model.floats("VEC3", &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -2.0]);
    model.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": target }]);
    model.animate(0, "weights", "LINEAR", &[0.0, 2.0], &[0.0, 1.0]);
}

#[test]
fn a_morph_target_adds_its_differences() {
    let mut model = Model::new();
    model.json["nodes"][0]["translation"] = json!([0, 0, 1]);
    morph(&mut model);
    let (said, scene) = import_with(&model, "--time 1s --fps 1");
    assert!(
        said.contains("1 deforming object with 5 key shapes"),
        "{said}"
    );
    for time in [-1.0, 0.0, 1.0] {
        assert_at(&scene, 0, time, [0.0, 0.0, 1.0]);
        assert_at(&scene, 2, time, [0.0, 1.0, 1.0 - (time + 1.0)]);
    }
}

#[test]
fn a_mesh_morphs_before_its_skin_moves_it() {
    let mut model = skinned(1);
    morph(&mut model);
    let scene = import(&model);
    assert_at(&scene, 2, 0.0, [0.0, 1.375, -1.0]);
}

#[test]
fn a_fixed_morph_weight_shapes_a_mesh_that_slides() {
    let mut model = Model::sliding();
    let target = model.floats("VEC3", &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -2.0]);
    model.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": target }]);
    model.json["meshes"][0]["weights"] = json!([0.5]);
    let scene = import(&model);
    assert!(scene.meshes[0].shapes.is_empty());
    assert_at(&scene, 2, 0.0, [1.0, 1.0, -1.0]);
}

#[test]
fn a_sheared_node_becomes_key_shapes() {
    let mut model = Model::new();
    model.json["nodes"][0] = json!({ "scale": [1, 3, 1], "children": [2] });
    model.push("nodes", json!({ "name": "thing", "mesh": 0 }));
    let half = 20f32.to_radians();
    let turns = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half.sin(), half.cos()];
    model.animate(2, "rotation", "LINEAR", &[0.0, 2.0], &turns);
    let scene = import(&model);
    assert!(!scene.meshes[0].shapes.is_empty());
    let (sine, cosine) = 20f64.to_radians().sin_cos();
    assert_at(&scene, 1, 0.0, [cosine, 3.0 * sine, 0.0]);
    assert_at(&scene, 2, 0.0, [-sine, 3.0 * cosine, 0.0]);
}

#[test]
fn the_camera_moves_by_its_node() {
    let mut model = Model::sliding();
    model.animate(
        1,
        "translation",
        "LINEAR",
        &[0.0, 2.0],
        &[0.0, 0.0, 5.0, 0.0, 2.0, 5.0],
    );
    let scene = import(&model);
    let camera = scene.camera.motion.at(0.0);
    assert!(camera.translation.distance(DVec3::new(0.0, 1.0, 5.0)) < 1e-9);
    assert!((scene.camera.vertical_fov_at(0.0) - 1.0).abs() < 1e-9);
}

#[test]
fn a_binary_file_is_the_same_scene() {
    let sandbox = Sandbox::new();
    Model::sliding().write_binary(&sandbox);
    sandbox.done("engine import models/model.glb --out scenes/thing --time 1s --fps 1");
    let scene = load_scene(sandbox.path("scenes/thing"), None).unwrap();
    assert_at(&scene, 1, 0.5, [2.5, 0.0, 0.0]);
}

#[test]
fn a_still_file_is_framed_and_gone_around_on_request() {
    let mut model = Model::new();
    model.json["cameras"] = json!([]);
    model.json["nodes"].as_array_mut().unwrap().pop();
    model.json["scenes"][0]["nodes"] = json!([0]);
    let (said, scene) = import_with(&model, "--orbit 3deg/frame");
    assert!(
        said.contains("has no perspective camera; one is framed on the model"),
        "{said}"
    );
    assert!(
        said.contains("has no light; a sky and a sun are added"),
        "{said}"
    );
    let [before, now] = [-1.0, 0.0].map(|time| scene.camera.motion.at(time).translation);
    let middle = DVec3::new(0.5, 0.5, 0.0);
    let [a, b] = [before, now].map(|place| (place - middle).reject_from(DVec3::Y));
    assert!((a.angle_between(b).to_degrees() - 3.0).abs() < 1e-6);
    assert!(vertex(&scene, 0, 0, 0.0).is_finite());
}
