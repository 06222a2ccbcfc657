//! Materials, textures, lights, and what is lost.

use glam::{DVec3, Vec2, Vec3};
use scene::{Finish, Scene, load_scene};
use serde_json::{Value, json};

use super::model::{MODEL, Model};
use super::{import_with, vertex};
use crate::sandbox::Sandbox;

/// Imports the sliding triangle with a material.
fn import_material(material: Value) -> (String, Scene) {
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
    assert_eq!(
        paint.finish,
        Finish::Coated {
            roughness: 0.5,
            index: 1.25
        }
    );
    let metal = json!({ "pbrMetallicRoughness": { "roughnessFactor": 0.25 } });
    let (_, scene) = import_material(metal);
    assert_eq!(
        scene.materials[0].finish,
        Finish::Conductor { roughness: 0.25 }
    );
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
        (
            material.opacity,
            material.translucency.is_some(),
            scene.objects[0].name.clone(),
        )
    };
    assert_eq!(
        alpha("BLEND", 0.25, 0.5),
        (0.25, true, "thing_blended".to_owned())
    );
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
    let transform = json!({ "offset": [0.5, 0.25], "rotation": 0.5, "scale": [2, 3] });
    let texture = json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
    model.push(
        "materials",
        json!({ "pbrMetallicRoughness": { "baseColorTexture": texture } }),
    );
    let primitive = &mut model.json["meshes"][0]["primitives"][0];
    primitive["material"] = json!(0);
    primitive["attributes"]["TEXCOORD_0"] = json!(texcoords);
    model.write(&sandbox);
    let dots = frame::Raster::filled(2, 2, [0.5; 3]);
    frame::write_png(&sandbox.path("models/two dots.png"), &dots).unwrap();
    sandbox.done(&format!("engine import {MODEL} --out scenes/thing"));
    let scene = load_scene(sandbox.path("scenes/thing"), None).unwrap();
    assert_eq!(scene.textures.len(), 1);
    let (sine, cosine) = 0.5_f32.sin_cos();
    // Turned counter-clockwise on screen, where v points down: (x, y) to (cx + sy, cy - sx).
    let expected = [
        [0.5, 0.25],
        [0.5 + 2.0 * cosine, 0.25 - 2.0 * sine],
        [0.5 + 3.0 * sine, 0.25 + 3.0 * cosine],
    ];
    for (texcoord, [u, v]) in scene.meshes[0].texcoords.iter().zip(expected) {
        let off = texcoord.distance(Vec2::new(u, 1.0 - v));
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
        let node = model.push(
            "nodes",
            json!({
                "rotation": [-half.sin(), 0, 0, half.cos()], "translation": [0, 3, 0],
                "extensions": { "KHR_lights_punctual": { "light": light } },
            }),
        );
        model.json["scenes"][0]["nodes"]
            .as_array_mut()
            .unwrap()
            .push(json!(node));
    }
    let (said, scene) = import_with(&model, "");
    let sun = scene.sun.unwrap();
    // Light goes along -Z of the node, here down.
    assert!(sun.direction.distance(DVec3::Y) < 1e-6, "{}", sun.direction);
    assert_eq!(sun.irradiance, Vec3::new(2.0, 1.0, 0.5));
    let lost = "no counterpart: 1 further sun (the strongest is used), 1 spot light";
    assert!(said.contains(lost), "{said}");
    let light = scene
        .materials
        .iter()
        .find(|material| material.name == "point_light_0")
        .unwrap();
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
    assert!(
        said.contains("no counterpart: vertex colours (0.8 % of the picture)"),
        "{said}"
    );
}

#[test]
fn an_exported_scene_comes_back_with_its_materials_and_motion() {
    let sandbox = Sandbox::new();
    sandbox.done("engine export plate --gltf gltf");
    // The frame is 2 frames of 1/24 s after the start.
    sandbox.done(
        "engine import gltf/plate/scene.gltf --time 0.0833333333s --fps 24 --out scenes/again",
    );
    let [first, again] =
        ["scenes/plate", "scenes/again"].map(|name| load_scene(sandbox.path(name), None).unwrap());
    assert_eq!(first.objects.len(), again.objects.len());
    for time in [-1.0, -0.5, 0.0, 1.0] {
        for object in 0..first.objects.len() {
            let [a, b] = [&first, &again].map(|scene| vertex(scene, object, 0, time));
            assert!(a.distance(b) < 1e-5, "{a} {b}");
        }
    }
    for material in &first.materials {
        let same = again
            .materials
            .iter()
            .find(|other| other.name == material.name)
            .unwrap();
        assert_eq!(same.diffuse, material.diffuse);
        assert_eq!(same.emission, material.emission);
        assert_eq!(same.finish, material.finish);
    }
}
