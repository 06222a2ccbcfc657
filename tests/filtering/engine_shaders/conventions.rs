//! Shaders that expect velocity, depth and colour as engines have them.

use std::fs;

use filters::Filter;

use super::{blur, busy_picture};

/// Copies velocity, depth and colour to the output, times a factor each.
const SHADER: &str = r"
@group(0) @binding(0) var color: texture_2d<f32>;
@group(0) @binding(1) var velocity: texture_2d<f32>;
@group(0) @binding(2) var depth: texture_2d<f32>;
@group(0) @binding(3) var output: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = vec2<u32>(textureDimensions(color));
    if any(id.xy >= size) { return; }
    let pixel = vec2<i32>(id.xy);
    let seen = vec3<f32>(textureLoad(velocity, pixel, 0).xy, textureLoad(depth, pixel, 0).x);
    textureStore(output, pixel, vec4<f32>(seen + 100.0 * textureLoad(color, pixel, 0).xyz, 1.0));
}
";

fn load(convention: &str) -> Filter {
    let folder = tempfile::tempdir().unwrap();
    let manifest = format!(
        "name = \"seen\"\nsummary = \"Shows what it sees.\"\nalignment = \"trailing\"\n{convention}\n[[pass]]\nshader = \"seen.wgsl\"\n"
    );
    fs::write(folder.path().join("filter.toml"), manifest).unwrap();
    fs::write(folder.path().join("seen.wgsl"), SHADER).unwrap();
    Filter::load(folder.path()).unwrap()
}

#[test]
fn a_shader_sees_what_its_engine_would_show_it() {
    let picture = busy_picture();
    // 61 x 43 pixels, exposure 0.7; pixel (12, 9) moves by (9.5, -4.25) at a depth of 14 m.
    let (width, height, exposure) = (61.0, 43.0, 0.7);
    let (x, y, z) = (9.5, -4.25, 14.0);
    let gray = f64::from(picture.color.at(12, 9)[0]);
    // (convention, expected velocity and depth, expected factor on colour)
    let cases: [(&str, [f64; 3], f64); 6] = [
        ("", [x, y, z], 1.0),
        (
            "[convention]\nvelocity = \"uv\"\nvelocity_sign = \"previous_minus_current\"",
            [-x / width, -y / height, z],
            1.0,
        ),
        (
            "[convention]\nvelocity = \"ndc\"\nvelocity_y = \"up\"\nvelocity_per = \"shutter\"",
            [2.0 * x / width * exposure, -2.0 * y / height * exposure, z],
            1.0,
        ),
        (
            "[convention]\nvelocity_per = \"second\"\nframes_per_second = 60",
            [60.0 * x, 60.0 * y, z],
            1.0,
        ),
        (
            "[convention]\nvelocity_scale = 0.5\ndepth = \"reversed\"\nnear = 0.1",
            [0.5 * x, 0.5 * y, 0.1 / z],
            1.0,
        ),
        (
            "[convention]\ncolor_scale = 4.0\ndepth = \"forward\"\nnear = 1\nfar = 29",
            [x, y, 1.0 - (29.0 - z) / (z * 28.0)],
            4.0,
        ),
    ];
    for (convention, seen, scale) in cases {
        let filter = load(convention);
        let output = blur(&filter, &filter.settings(None).unwrap(), &picture);
        for (channel, seen) in seen.into_iter().enumerate() {
            // The output is divided by the factor that colours were multiplied by.
            let expected = seen / scale + 100.0 * gray;
            let found = f64::from(output.at(12, 9)[channel]);
            let difference = (found - expected).abs();
            assert!(
                difference < 1e-3,
                "{convention}: channel {channel}: {found}, not {expected}"
            );
        }
    }
}

#[test]
fn an_unknown_convention_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (convention, says) in [
        ("velocity = \"metres\"", "metres"),
        ("speed = \"uv\"", "unknown field `speed`"),
        ("depth = \"reversed\"", "needs near"),
        (
            "depth_format = \"rgba16float\"",
            "depth_format = \"rgba16float\"; allowed: r32float, r16float",
        ),
    ] {
        let manifest = format!(
            "name = \"seen\"\nsummary = \"\"\nalignment = \"trailing\"\n[convention]\n{convention}\n[[pass]]\nshader = \"seen.wgsl\"\n"
        );
        fs::write(folder.path().join("filter.toml"), manifest).unwrap();
        let message = Filter::load(folder.path()).unwrap_err().to_string();
        assert!(
            message.contains("filter.toml:") && message.contains(says),
            "{message}"
        );
    }
}
