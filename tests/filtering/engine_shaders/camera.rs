//! Values that engines set every frame: matrices of the camera, the picture's size, jitter and times.

use std::fmt::Write;

use filters::{Blur, Filter, Input};
use frame::{Camera, CameraPose, Frame, Image};
use tests::open_gpu;
use tests::text::assert_contains;

use super::super::camera_gather::render_frame;
use super::{assert_refused, blur, busy_picture, make};

/// Writes the velocity that depth and the camera give, in pixels.
const GLSL: &str = r"#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D depth;
layout(rgba32f, set = 0, binding = 1) uniform writeonly image2D picture;

layout(set = 0, binding = 2, std140) uniform Scene {
    float padding;
    LAYOUT mat4 inverse_projection;
    LAYOUT mat4 inverse_view;
    mat4 previous;
    vec2 resolution;
    vec2 jitter;
} scene;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(scene.resolution)))) {
        return;
    }
    vec2 uv = (vec2(pixel) + 0.5 + scene.jitter) / scene.resolution;
    float z = texelFetch(depth, pixel, 0).x;
    vec4 seen = scene.inverse_projection * vec4(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, z, 1.0);
    vec4 before = scene.previous * (scene.inverse_view * seen);
    vec2 place = before.w > 0.0 ? vec2(0.5, -0.5) * before.xy / before.w + 0.5 : uv;
    imageStore(picture, pixel, vec4((uv - place) * scene.resolution, 0.0, 1.0));
}
";

/// The same; matrices of HLSL act on columns here, and lie in memory column by column.
const HLSL: &str = r"
Texture2D<float4> depth : register(t0);
RWTexture2D<float4> picture : register(u0);

cbuffer Scene : register(b0)
{
    float padding;
    LAYOUT float4x4 inverse_projection;
    LAYOUT float4x4 inverse_view;
    float4x4 previous;
    float2 resolution;
    float2 jitter;
};

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    if (id.x >= (uint)resolution.x || id.y >= (uint)resolution.y)
        return;
    float2 uv = (id.xy + 0.5 + jitter) / resolution;
    float4 seen = mul(inverse_projection, float4(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, depth.Load(int3(id.xy, 0)).x, 1.0));
    float4 before = mul(previous, mul(inverse_view, seen));
    float2 place = before.w > 0.0 ? float2(0.5, -0.5) * before.xy / before.w + 0.5 : uv;
    picture[id.xy] = float4((uv - place) * resolution, 0.0, 1.0);
}
";

const WGSL: &str = r"
struct Scene {
    padding: f32,
    inverse_projection: mat4x4<f32>,
    inverse_view: mat4x4<f32>,
    previous: mat4x4<f32>,
    resolution: vec2<f32>,
    jitter: vec2<f32>,
}
@group(0) @binding(0) var depth: texture_2d<f32>;
@group(0) @binding(1) var picture: texture_storage_2d<rgba32float, write>;
@group(0) @binding(2) var<uniform> scene: Scene;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(vec2<f32>(id.xy) >= scene.resolution) { return; }
    let uv = (vec2<f32>(id.xy) + 0.5 + scene.jitter) / scene.resolution;
    let z = textureLoad(depth, id.xy, 0).x;
    let seen = scene.inverse_projection * vec4<f32>(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, z, 1.0);
    let before = scene.previous * (scene.inverse_view * seen);
    let place = select(uv, vec2<f32>(0.5, -0.5) * before.xy / before.w + 0.5, before.w > 0.0);
    textureStore(picture, id.xy, vec4<f32>((uv - place) * scene.resolution, 0.0, 1.0));
}
";

/// Declares the filter; `bindings` are those of depth, the picture and the block.
fn declare(file: &str, [depth, picture, block]: [u32; 3], convention: &str) -> String {
    format!(
        "[convention]\n{convention}\n[[pass]]\nshader = \"{file}\"\n\
         [[pass.binding]]\nbinding = {depth}\ntexture = \"depth\"\nsampler = \"nearest\"\n\
         [[pass.binding]]\nbinding = {picture}\ntexture = \"output\"\n\
         [[pass.binding]]\nbinding = {block}\nvalues = {{ padding = 0, previous = \"previous_view_projection\" }}\n"
    )
}

fn run(filter: &Filter, frame: &Frame, camera: Option<Camera>) -> Result<Image, String> {
    let gpu = open_gpu();
    let (width, height) = frame.size();
    let settings = filter.settings(None).unwrap();
    let mut blur = Blur::new(&gpu, filter, &settings, width, height).unwrap();
    let input = Input {
        color: &[&frame.color],
        velocity: &frame.velocity,
        depth: &frame.depth,
        reprojection: None,
        camera,
        exposure: frame.exposure,
        frames_per_second: frame.frames_per_second,
        frame_index: 0,
    };
    let outputs = blur.run(&input).map_err(|error| error.to_string());
    outputs.map(|mut outputs| outputs.remove(0))
}

#[test]
fn depth_and_the_camera_s_matrices_give_its_velocity_in_every_language() {
    let (reversed, forward) = (
        "depth = \"reversed\"\nnear = 0.1",
        "depth = \"forward\"\nnear = 0.5\nfar = 40",
    );
    let shaders = [
        ("move.comp", GLSL.replace("LAYOUT", ""), [0, 1, 2]),
        // Engines that keep rows hand over rows.
        (
            "move.comp",
            GLSL.replace("LAYOUT", "layout(row_major)"),
            [0, 1, 2],
        ),
        ("move.hlsl", HLSL.replace("LAYOUT", ""), [100, 200, 0]),
        (
            "move.hlsl",
            HLSL.replace("LAYOUT", "row_major"),
            [100, 200, 0],
        ),
        ("move.wgsl", WGSL.to_owned(), [0, 1, 2]),
    ];
    for guard_band in [0, 7] {
        let frame = render_frame(guard_band);
        for (index, (file, text, bindings)) in shaders.iter().enumerate() {
            for convention in [reversed, forward, "depth = \"ndc\"\nnear = 0.5\nfar = 40"] {
                let declarations = declare(file, *bindings, convention);
                let filter = make(&declarations, &[(file, text)]).unwrap();
                let output = run(&filter, &frame, frame.camera).unwrap();
                let pixels = output.pixels.iter().zip(&frame.velocity.pixels);
                let depths = frame.depth.pixels.iter();
                let compared = pixels.zip(depths).filter(|(_, depth)| **depth < 30.0);
                let mut worst = 0.0_f32;
                for ((found, expected), _) in compared {
                    worst = (0..2)
                        .map(|i| (found[i] - expected[i]).abs())
                        .fold(worst, f32::max);
                }
                // Depth of 32 bits between 0 and 1, and a division by it.
                assert!(
                    worst < 0.02,
                    "shader {index} {file}, {convention}: {worst} pixels"
                );
            }
        }
    }
    let fastest = render_frame(0)
        .velocity
        .pixels
        .iter()
        .map(|v| v[0].hypot(v[1]))
        .fold(0.0, f32::max);
    assert!(
        fastest > 5.0,
        "the camera moves: {fastest} pixels per frame"
    );
}

#[test]
fn every_value_of_a_frame_has_the_number_that_its_name_says() {
    // (name, expected)
    let pose = CameraPose {
        to_world: [
            [0.0, 0.0, -1.0, 5.0],
            [0.0, 1.0, 0.0, 6.0],
            [1.0, 0.0, 0.0, 7.0],
        ],
        ..CameraPose::at_origin(43.0)
    };
    let before = CameraPose::at_origin(86.0);
    let expected: [(&str, f32); 22] = [
        ("width", 61.0),
        ("height", 43.0),
        ("resolution[1]", 43.0),
        ("jitter[0]", 0.0),
        ("frame_index", 3.0),
        ("exposure", 0.7),
        ("delta_time", 0.02),
        ("frames_per_second", 50.0),
        ("color_scale", 2.0),
        ("near", 0.5),
        ("iteration", 0.0),
        ("iterations", 1.0),
        ("inverse_view[12]", 5.0),
        ("inverse_view[13]", 6.0),
        ("inverse_view[2]", 1.0),
        ("view[8]", 1.0),
        ("projection[5]", 2.0),
        ("projection[11]", -1.0),
        ("previous_projection[5]", 4.0),
        ("previous_inverse_view[12]", 0.0),
        ("inverse_projection[5]", 0.5),
        ("previous_inverse_view_projection[5]", 0.25),
    ];
    let mut members = String::new();
    let mut values = String::new();
    for (index, (name, _)) in expected.iter().enumerate() {
        writeln!(members, "    value_{index}: f32,").unwrap();
        write!(values, "value_{index} = \"{name}\", ").unwrap();
    }
    let sums: Vec<String> = (0..expected.len())
        .map(|index| format!("select(0.0, values.value_{index}, id.x == {index}u)"))
        .collect();
    let shader = format!(
        "struct Values {{\n{members}}}\n@group(0) @binding(0) var<uniform> values: Values;\n\
         @group(0) @binding(1) var output: texture_storage_2d<rgba32float, write>;\n\
         @compute @workgroup_size(8, 8)\nfn main(@builtin(global_invocation_id) id: vec3<u32>) {{\n\
         textureStore(output, id.xy, vec4<f32>({}));\n}}\n",
        sums.join(" + ")
    );
    let declarations = format!(
        "[convention]\nframes_per_second = 50\ncolor_scale = 2\ndepth = \"reversed\"\nnear = 0.5\n\
         [[pass]]\nshader = \"show.wgsl\"\n[[pass.binding]]\nbinding = 0\nvalues = {{ {} }}\n",
        values.trim_end_matches(", ")
    );
    let filter = make(&declarations, &[("show.wgsl", &shader)]).unwrap();
    let picture = busy_picture();
    let gpu = open_gpu();
    let settings = filter.settings(None).unwrap();
    let mut blur = Blur::new(&gpu, &filter, &settings, 61, 43).unwrap();
    let colors = [&picture.color];
    let input = Input {
        frame_index: 3,
        camera: Some(Camera { now: pose, before }),
        ..picture.input(&colors)
    };
    let output = blur.run(&input).unwrap().remove(0);
    for (index, (name, expected)) in expected.into_iter().enumerate() {
        // Colours are divided by their scale.
        let found = 2.0 * output.at(index as u32, 3)[0];
        assert!(
            (found - expected).abs() < 1e-5,
            "{name}: {found}, not {expected}"
        );
    }
}

#[test]
fn a_frame_without_its_camera_is_refused() {
    let frame = render_frame(0);
    let declarations = declare("move.wgsl", [0, 1, 2], "depth = \"reversed\"\nnear = 0.1");
    let filter = make(&declarations, &[("move.wgsl", WGSL)]).unwrap();
    let refusal = run(&filter, &frame, None).unwrap_err();
    let parts = [
        "does not say where its camera was",
        "\"camera\"",
        "`render`",
    ];
    assert_contains(&refusal, &parts);
    // One that takes no matrix needs no camera.
    let plain = "[[pass]]\nshader = \"plain.wgsl\"\nstage = \"fragment\"\n[[pass.binding]]\nbinding = 0\nvalues = { size = \"resolution\" }\n";
    let shader = "@group(0) @binding(0) var<uniform> size: vec2<f32>;\n\
                  @fragment fn main() -> @location(0) vec4<f32> { return vec4<f32>(size, 0.0, 1.0); }\n";
    let plain = plain.replace("size = ", "\"@0\" = ");
    let filter = make(&plain, &[("plain.wgsl", shader)]).unwrap();
    let output = blur(&filter, &filter.settings(None).unwrap(), &busy_picture());
    assert_eq!(*output.at(4, 4), [61.0, 43.0, 0.0]);
}

#[test]
fn values_that_the_convention_does_not_give_are_refused() {
    let declarations = declare("move.wgsl", [0, 1, 2], "depth = \"reversed\"\nnear = 0.1");
    #[rustfmt::skip]
    assert_refused(&declarations, &[("move.wgsl", WGSL)], &[
        ("depth = \"reversed\"\nnear = 0.1", "", &["filter.toml:", "previous_view_projection\" needs near", "[convention]"]),
        ("\"previous_view_projection\"", "\"delta_time\"", &["filter.toml:", "delta_time\" needs frames_per_second in [convention]"]),
        ("\"previous_view_projection\"", "\"last_view_projection\"", &["filter.toml:", "unknown name \"last_view_projection\"", "previous_view_projection"]),
        ("\"previous_view_projection\"", "\"2 * view\"", &["filter.toml:", "unknown name \"view\"", "arithmetic takes one of several numbers"]),
        ("\"previous_view_projection\"", "\"view[16]\"", &["filter.toml:", "unknown name \"view[16]\""]),
        ("\"previous_view_projection\"", "\"width[0]\"", &["filter.toml:", "unknown name \"width[0]\""]),
        ("\"previous_view_projection\"", "\"previous_previous_view\"", &["filter.toml:", "unknown name \"previous_previous_view\""]),
        ("\"previous_view_projection\"", "\"far\"", &["filter.toml:", "far\" needs to stand in [convention]"]),
        ("\"previous_view_projection\"", "\"resolution\"", &["filter.toml:", "member \"previous\" holds 16 x f32", "has 2"]),
        ("padding = 0", "padding = \"view\"", &["filter.toml:", "member \"padding\" holds f32", "has 16"]),
    ]);
    let narrow = WGSL.replace("jitter: vec2<f32>", "jitter: vec2<f32>, view: mat3x3<f32>");
    let error = make(&declarations, &[("move.wgsl", &narrow)]).unwrap_err();
    let parts = ["member \"view\" (9 x f32 at byte 224) has no value"];
    assert_contains(&error.to_string(), &parts);
}
