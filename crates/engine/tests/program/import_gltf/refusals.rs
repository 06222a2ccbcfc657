//! Files that are broken or compressed, and requests that a file cannot meet.

use serde_json::json;

use super::model::{MODEL, Model};
use super::skinned;
use crate::sandbox::{Sandbox, assert_refused, split};

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
        (
            "KHR_draco_mesh_compression",
            "npx @gltf-transform/cli copy \"model.gltf\" plain.glb",
        ),
        ("EXT_meshopt_compression", "npx @gltf-transform/cli copy"),
        (
            "KHR_texture_basisu",
            "npx @gltf-transform/cli ktxdecompress",
        ),
        (
            "EXT_texture_webp",
            "npx @gltf-transform/cli png --formats webp",
        ),
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
    refuse(
        two,
        "",
        &["nodes[2] is a child of nodes[0] and of nodes[1]"],
    );
    let missing = |model: &mut Model| model.json["nodes"][0]["mesh"] = json!(7);
    refuse(missing, "", &["meshes[7] is named, but there are 1 meshes"]);
    let beyond = |model: &mut Model| model.json["accessors"][0]["count"] = json!(1000);
    refuse(
        beyond,
        "",
        &["accessors[0] (positions)", "1000 elements of 12 bytes"],
    );
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
    for (weight, parts) in [
        (f32::NAN, "holds NaN at element 1"),
        (0.0, "the weights of vertex 1 sum to 0"),
    ] {
        let sandbox = Sandbox::new();
        let mut model = skinned(1);
        let weights = model.floats(
            "VEC4",
            &[
                1.0, 0.0, 0.0, 0.0, 0.0, weight, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0,
            ],
        );
        model.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = json!(weights);
        model.write(&sandbox);
        sandbox.refuse(
            &format!("engine import {MODEL} --out scenes/thing"),
            &[parts],
        );
    }
}

#[test]
fn missing_buffers_and_bad_data_uris_are_refused() {
    for (uri, parts) in [
        ("no.bin", "no.bin"),
        (
            "../model.bin",
            "allowed: files in the folder of the glTF file",
        ),
        ("data:;base64,AA*A", "is no base64"),
        ("data:,AAAA", "allowed: data:TYPE;base64,DATA"),
        ("data:;base64,AAAA", "has 3 bytes; its byteLength says"),
    ] {
        let sandbox = Sandbox::new();
        let model = Model::sliding();
        model.write(&sandbox);
        sandbox.edit(MODEL, "model.bin", uri);
        sandbox.refuse(
            &format!("engine import {MODEL} --out scenes/thing"),
            &["buffers[0]", parts],
        );
    }
    let sandbox = Sandbox::new();
    sandbox.put("models/model.glb", vec![0; 100]);
    sandbox.refuse(
        "engine import models/model.glb --out scenes/thing",
        &["model.glb", "begins neither with glTF"],
    );
}

#[test]
fn requests_that_a_file_cannot_meet_are_refused_with_the_way_out() {
    let as_is = |_: &mut Model| {};
    refuse(as_is, "--time 3s", &["lasts from 0 s to 2 s"]);
    refuse(
        as_is,
        "--animation run",
        &["has no animation \"run\"", "\"walk\""],
    );
    refuse(
        as_is,
        "--camera other",
        &["has no camera \"other\"", "\"eye\""],
    );
    refuse(
        as_is,
        "--spin 3deg/frame",
        &["--spin is for OBJ files", "--orbit"],
    );
    refuse(as_is, "--time 3", &["--time", "1.25s"]);
    refuse(as_is, "--fps 0", &["--fps", "allowed: 1 to 1000"]);
    let flat = |model: &mut Model| model.json["cameras"] = json!([{ "type": "orthographic" }]);
    refuse(
        flat,
        "--camera eye",
        &["\"eye\" is orthographic", "leave --camera out"],
    );
    let still = |model: &mut Model| model.json["animations"] = json!([]);
    refuse(still, "", &["has no animation", "--orbit 3deg/frame"]);
}
