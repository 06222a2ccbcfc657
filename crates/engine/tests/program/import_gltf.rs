//! `import` of glTF: small files of one rule each, with answers by hand.

use glam::{DVec3, Vec3};
use scene::{Finish, Scene, load_scene};
use serde_json::json;

use super::gltf_model::{MODEL, Model};
use crate::sandbox::{Sandbox, assert_done, assert_refused, split, stdout};

/// Imports a model; returns what was said and the scene. The frame is at 1 s and a frame takes a
/// second, unless `more` says otherwise.
fn import_with(model: &Model, more: &str) -> (String, Scene) {
    let sandbox = Sandbox::new();
    model.write(&sandbox);
    let words = ["engine", "import", MODEL, "--out", "scenes/thing"];
    let output = sandbox.shuttertruth(&[&words, &split(more)[..]].concat());
    assert_done(&output);
    let said = stdout(&output) + &String::from_utf8_lossy(&output.stderr);
    (said, load_scene(sandbox.path("scenes/thing"), None).unwrap())
}

fn import(model: &Model) -> Scene {
    import_with(model, "--time 1s --fps 1").1
}

/// Returns where a vertex of an object is in the world.
fn vertex(scene: &Scene, object: usize, vertex: u32, time: f64) -> DVec3 {
    let mesh = &scene.meshes[scene.objects[object].mesh];
    scene.object_to_world(object, time).transform_point3(mesh.at(time).position(vertex))
}

/// Positions are rounded to 32 bits.
#[track_caller]
fn assert_at(scene: &Scene, number: u32, time: f64, expected: [f64; 3]) {
    let place = vertex(scene, 0, number, time);
    let off = place.distance(DVec3::from(expected));
    assert!(off < 1e-5, "vertex {number} at {time}: {place}, not {expected:?}");
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
    assert!(said.contains("animation \"walk\" at 1 s, 4 frames per second"), "{said}");
}

#[test]
fn a_step_jumps_at_its_key() {
    let mut model = Model::new();
    let places = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 0.0];
    model.animate(0, "translation", "STEP", &[0.0, 1.5, 2.0], &places);
    let scene = import(&model);
    for (time, x) in [(-1.0, 0.0), (0.0, 0.0), (0.498, 0.0), (0.5, 1.0), (0.99, 1.0), (1.0, 3.0), (2.0, 3.0)] {
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
fn a_child_moves_with_its_turning_parent() {
    let mut model = Model::new();
    model.json["nodes"][0] = json!({ "name": "parent", "translation": [0, 1, 0], "children": [2] });
    let child = json!({ "name": "thing", "mesh": 0, "translation": [1, 0, 0], "scale": [1, 1, -2] });
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
fn skinned(sets: usize) -> Model {
    let mut model = Model::new();
    // The node's own place does not count.
    model.json["nodes"][0] = json!({ "name": "thing", "mesh": 0, "skin": 0, "translation": [9, 9, 9] });
    model.push("nodes", json!({ "children": [3] }));
    model.push("nodes", json!({ "translation": [0, 0, 0] }));
    model.json["scenes"][0]["nodes"] = json!([0, 1, 2]);
    let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let mut moved = identity;
    // The second joint's bind pose is a metre to the right.
    moved[12] = -1.0;
    let inverse = model.floats("MAT4", &[identity, moved].concat());
    model.push("skins", json!({ "joints": [2, 3], "inverseBindMatrices": inverse }));
    model.animate(3, "translation", "LINEAR", &[0.0, 2.0], &[1.0, 0.0, 0.0, 1.0, 1.0, 0.0]);
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
    assert!(said.contains("1 deforming"), "{said}");
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
    model.animate(1, "translation", "LINEAR", &[0.0, 2.0], &[0.0, 0.0, 5.0, 0.0, 2.0, 5.0]);
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

/// Imports the sliding triangle with a material.
fn import_material(material: serde_json::Value) -> (String, Scene) {
    let mut model = Model::sliding();
    model.push("materials", material);
    model.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    import_with(&model, "")
}

#[test]
fn factors_of_a_material_become_those_of_the_scene() {
    let (_, scene) = import_material(json!({
        "name": "paint",
        "pbrMetallicRoughness": { "baseColorFactor": [0.25, 0.5, 0.75, 1], "metallicFactor": 0, "roughnessFactor": 0.5 },
        "emissiveFactor": [1, 0.5, 0],
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 3 }, "KHR_materials_ior": { "ior": 1.25 } },
    }));
    let paint = &scene.materials[0];
    assert_eq!(paint.name, "paint");
    assert_eq!(paint.diffuse, Vec3::new(0.25, 0.5, 0.75));
    assert_eq!(paint.emission, Vec3::new(3.0, 1.5, 0.0));
    assert_eq!(paint.finish, Finish::Coated { roughness: 0.5, index: 1.25 });
    let metal = json!({ "pbrMetallicRoughness": { "roughnessFactor": 0.25 } });
    let (_, scene) = import_material(metal);
    assert_eq!(scene.materials[0].finish, Finish::Conductor { roughness: 0.25 });
}

#[test]
fn an_unlit_material_sends_out_its_colour() {
    let (_, scene) = import_material(json!({
        "pbrMetallicRoughness": { "baseColorFactor": [0.25, 0.5, 0.75, 1] },
        "extensions": { "KHR_materials_unlit": {} },
    }));
    assert!(scene.is_unlit());
    assert_eq!(scene.materials[0].emission, Vec3::new(0.25, 0.5, 0.75));
}

#[test]
fn blended_materials_let_light_through_and_masks_cut() {
    let alpha = |mode: &str, alpha: f64, cutoff: f64| {
        let (_, scene) = import_material(json!({
            "alphaMode": mode, "alphaCutoff": cutoff,
            "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, alpha], "metallicFactor": 0 },
        }));
        let material = &scene.materials[0];
        (material.opacity, material.translucency.is_some(), scene.objects[0].name.clone())
    };
    assert_eq!(alpha("BLEND", 0.25, 0.5), (0.25, true, "thing_blended".to_owned()));
    assert_eq!(alpha("MASK", 0.25, 0.2), (1.0, false, "thing".to_owned()));
    assert_eq!(alpha("MASK", 0.25, 0.3), (0.0, false, "thing".to_owned()));
    assert_eq!(alpha("OPAQUE", 0.25, 0.5), (1.0, false, "thing".to_owned()));
}

#[test]
fn a_texture_transform_is_applied_to_coordinates() {
    let sandbox = Sandbox::new();
    let mut model = Model::sliding();
    let texcoords = model.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    model.json["images"] = json!([{ "uri": "two%20dots.png" }]);
    model.json["textures"] = json!([{ "source": 0 }]);
    let transform = json!({ "offset": [0.5, 0.25], "rotation": 0.5236, "scale": [2, 3] });
    let texture = json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
    model.push("materials", json!({ "pbrMetallicRoughness": { "baseColorTexture": texture } }));
    let primitive = &mut model.json["meshes"][0]["primitives"][0];
    primitive["material"] = json!(0);
    primitive["attributes"]["TEXCOORD_0"] = json!(texcoords);
    model.write(&sandbox);
    let dots = frame::Raster::filled(2, 2, [0.5; 3]);
    frame::write_png(&sandbox.path("models/two dots.png"), &dots).unwrap();
    sandbox.done(&format!("engine import {MODEL} --out scenes/thing"));
    let scene = load_scene(sandbox.path("scenes/thing"), None).unwrap();
    assert_eq!(scene.textures.len(), 1);
    let (sine, cosine) = 0.5236f32.sin_cos();
    // Turned counter-clockwise on screen, where v points down: (x, y) to (cx + sy, cy - sx).
    let expected = [[0.5, 0.25], [0.5 + 2.0 * cosine, 0.25 - 2.0 * sine], [0.5 + 3.0 * sine, 0.25 + 3.0 * cosine]];
    for (texcoord, [u, v]) in scene.meshes[0].texcoords.iter().zip(expected) {
        let off = texcoord.distance(glam::Vec2::new(u, 1.0 - v));
        assert!(off < 1e-5, "{texcoord} is not {u}, 1 - {v}");
    }
}

#[test]
fn the_strongest_sun_and_point_lights_shine() {
    let mut model = Model::sliding();
    model.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "directional", "intensity": 1 },
        { "type": "directional", "intensity": 2, "color": [1, 0.5, 0.25] },
        { "type": "point", "intensity": 5 },
        { "type": "spot", "spot": {} },
    ] } });
    let half = 45f64.to_radians();
    for light in 0..4 {
        let node = model.push("nodes", json!({
            "rotation": [-half.sin(), 0, 0, half.cos()], "translation": [0, 3, 0],
            "extensions": { "KHR_lights_punctual": { "light": light } },
        }));
        model.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(node));
    }
    let (said, scene) = import_with(&model, "");
    let sun = scene.sun.unwrap();
    // Light goes along -Z of the node, here down.
    assert!(sun.direction.distance(DVec3::Y) < 1e-6, "{}", sun.direction);
    assert_eq!(sun.irradiance, Vec3::new(2.0, 1.0, 0.5));
    let lost = "no counterpart: 1 further sun (the strongest is used), 1 spot light";
    assert!(said.contains(lost), "{said}");
    let light = scene.materials.iter().find(|material| material.name == "point_light_0").unwrap();
    let mesh = &scene.meshes[1];
    let area: f32 = (mesh.triangles.iter())
        .map(|triangle| {
            let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize]);
            0.5 * (b - a).cross(c - a).length()
        })
        .sum();
    // A convex body shows a quarter of its surface on average.
    let intensity = light.emission.x * area / 4.0;
    assert!((intensity - 5.0).abs() < 0.01, "{intensity}");
}

#[test]
fn lost_features_are_listed_with_their_share_of_the_picture() {
    let mut model = Model::sliding();
    let colors = model.floats("VEC4", &[1.0; 12]);
    model.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
    let (said, _) = import_with(&model, "");
    // Half a square metre. At 5 m the picture is 5.46 m high and twice as wide, 59.7 m2: 0.8 %.
    assert!(said.contains("no counterpart: vertex colours (0.8 % of the picture)"), "{said}");
}

#[test]
fn an_exported_scene_comes_back_with_its_materials_and_motion() {
    let sandbox = Sandbox::new();
    sandbox.done("engine export plate --gltf gltf");
    // The frame is 2 frames of 1/24 s after the start.
    sandbox.done("engine import gltf/plate/scene.gltf --time 0.0833333333s --fps 24 --out scenes/again");
    let [first, again] = ["scenes/plate", "scenes/again"].map(|name| load_scene(sandbox.path(name), None).unwrap());
    assert_eq!(first.objects.len(), again.objects.len());
    for time in [-1.0, -0.5, 0.0, 1.0] {
        for object in 0..first.objects.len() {
            let [a, b] = [&first, &again].map(|scene| vertex(scene, object, 0, time));
            assert!(a.distance(b) < 1e-5, "{a} {b}");
        }
    }
    for material in &first.materials {
        let same = again.materials.iter().find(|other| other.name == material.name).unwrap();
        assert_eq!(same.diffuse, material.diffuse);
        assert_eq!(same.emission, material.emission);
        assert_eq!(same.finish, material.finish);
    }
}

/// Refuses the import of a model that was changed.
#[track_caller]
fn refuse(change: impl FnOnce(&mut Model), more: &str, parts: &[&str]) {
    let sandbox = Sandbox::new();
    let mut model = Model::sliding();
    change(&mut model);
    model.write(&sandbox);
    let words = ["engine", "import", MODEL, "--out", "scenes/thing"];
    let output = sandbox.shuttertruth(&[&words, &split(more)[..]].concat());
    assert_refused(&output, 2, parts);
    assert!(!sandbox.path("scenes/thing").exists());
}

#[test]
fn compressed_files_are_refused_with_the_command_that_helps() {
    for (name, command) in [
        ("KHR_draco_mesh_compression", "npx @gltf-transform/cli copy \"model.gltf\" plain.glb"),
        ("EXT_meshopt_compression", "npx @gltf-transform/cli copy"),
        ("KHR_texture_basisu", "npx @gltf-transform/cli ktxdecompress"),
        ("EXT_texture_webp", "npx @gltf-transform/cli png --formats webp"),
    ] {
        let require = |model: &mut Model| model.json["extensionsRequired"] = json!([name]);
        refuse(require, "", &["model.gltf", name, command]);
    }
    let unknown = |model: &mut Model| model.json["extensionsRequired"] = json!(["ACME_secret"]);
    refuse(unknown, "", &["requires the extension ACME_secret"]);
}

#[test]
fn broken_files_are_refused_with_the_place() {
    let parent = |model: &mut Model| model.json["nodes"][0]["children"] = json!([0]);
    refuse(parent, "", &["nodes[0] is among its own parents"]);
    let two = |model: &mut Model| {
        model.json["nodes"][0]["children"] = json!([2]);
        model.json["nodes"][1]["children"] = json!([2]);
        model.push("nodes", json!({}));
    };
    refuse(two, "", &["nodes[2] is a child of nodes[0] and of nodes[1]"]);
    let missing = |model: &mut Model| model.json["nodes"][0]["mesh"] = json!(7);
    refuse(missing, "", &["meshes[7] is named, but there are 1 meshes"]);
    let beyond = |model: &mut Model| model.json["accessors"][0]["count"] = json!(1000);
    refuse(beyond, "", &["accessors[0] (positions)", "1000 elements of 12 bytes"]);
    let outside = |model: &mut Model| {
        let indices = model.bytes("SCALAR", 3, &[0, 1, 3]);
        model.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    };
    refuse(outside, "", &["an index is 3, and there are 3 vertices"]);
    let back = |model: &mut Model| {
        model.json["animations"] = json!([]);
        model.animate(0, "translation", "LINEAR", &[1.0, 0.5], &[0.0; 6]);
    };
    refuse(back, "", &["animations[0].channels[0]", "times must rise"]);
    let empty = |model: &mut Model| model.json["nodes"][0] = json!({});
    refuse(empty, "", &["shows no triangles"]);
    let many = |model: &mut Model| model.json["nodes"] = json!(vec![json!({}); 65_537]);
    refuse(many, "", &["a list has more than 65536 entries"]);
}

#[test]
fn weights_that_are_no_weights_are_refused() {
    for (weight, parts) in [(f32::NAN, "holds NaN at element 1"), (0.0, "the weights of vertex 1 sum to 0")] {
        let sandbox = Sandbox::new();
        let mut model = skinned(1);
        let weights = model.floats("VEC4", &[1.0, 0.0, 0.0, 0.0, 0.0, weight, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
        model.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = json!(weights);
        model.write(&sandbox);
        sandbox.refuse(&format!("engine import {MODEL} --out scenes/thing"), &[parts]);
    }
}

#[test]
fn missing_buffers_and_bad_data_uris_are_refused() {
    for (uri, parts) in [
        ("no.bin", "no.bin"),
        ("../model.bin", "allowed: files in the folder of the glTF file"),
        ("data:;base64,AA*A", "is no base64"),
        ("data:,AAAA", "allowed: data:TYPE;base64,DATA"),
        ("data:;base64,AAAA", "has 3 bytes; its byteLength says"),
    ] {
        let sandbox = Sandbox::new();
        let model = Model::sliding();
        model.write(&sandbox);
        sandbox.edit(MODEL, "model.bin", uri);
        sandbox.refuse(&format!("engine import {MODEL} --out scenes/thing"), &["buffers[0]", parts]);
    }
    let sandbox = Sandbox::new();
    sandbox.put("models/model.glb", vec![0; 100]);
    sandbox.refuse("engine import models/model.glb --out scenes/thing", &["model.glb", "begins neither with glTF"]);
}

#[test]
fn requests_that_a_file_cannot_meet_are_refused_with_the_way_out() {
    let as_is = |_: &mut Model| {};
    refuse(as_is, "--time 3s", &["lasts from 0 s to 2 s"]);
    refuse(as_is, "--animation run", &["has no animation \"run\"", "\"walk\""]);
    refuse(as_is, "--camera other", &["has no camera \"other\"", "\"eye\""]);
    refuse(as_is, "--spin 3deg/frame", &["--spin is for OBJ files", "--orbit"]);
    refuse(as_is, "--time 3", &["--time", "1.25s"]);
    refuse(as_is, "--fps 0", &["--fps", "allowed: 1 to 1000"]);
    let flat = |model: &mut Model| model.json["cameras"] = json!([{ "type": "orthographic" }]);
    refuse(flat, "--camera eye", &["\"eye\" is orthographic", "leave --camera out"]);
    let still = |model: &mut Model| model.json["animations"] = json!([]);
    refuse(still, "", &["has no animation", "--orbit 3deg/frame"]);
}

#[test]
fn a_still_file_is_framed_and_gone_around_on_request() {
    let mut model = Model::new();
    model.json["cameras"] = json!([]);
    model.json["nodes"].as_array_mut().unwrap().pop();
    model.json["scenes"][0]["nodes"] = json!([0]);
    let (said, scene) = import_with(&model, "--orbit 3deg/frame");
    assert!(said.contains("has no perspective camera; one is framed on the model"), "{said}");
    assert!(said.contains("has no light; a sky and a sun are added"), "{said}");
    let [before, now] = [-1.0, 0.0].map(|time| scene.camera.motion.at(time).translation);
    let middle = DVec3::new(0.5, 0.5, 0.0);
    let [a, b] = [before, now].map(|place| (place - middle).reject_from(DVec3::Y));
    assert!((a.angle_between(b).to_degrees() - 3.0).abs() < 1e-6);
    assert!(vertex(&scene, 0, 0, 0.0).is_finite());
}
