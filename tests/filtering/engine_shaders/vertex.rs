//! Fragment shaders with a vertex stage of their own.

use super::{assert_refused, blur, busy_picture, largest_difference, make};

const WGSL: &str = r"
struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) uv: vec2<f32>,
}

@vertex
fn full_screen(@builtin(vertex_index) index: u32) -> Corner {
    let uv = vec2<f32>(f32(index >> 1u), f32(index & 1u)) * 2.0;
    return Corner(vec4<f32>(uv * vec2<f32>(2.0, -2.0) + vec2<f32>(-1.0, 1.0), 0.0, 1.0), uv);
}

@group(0) @binding(0) var color: texture_2d<f32>;
@group(0) @binding(1) var color_sampler: sampler;

@fragment
fn main(in: Corner) -> @location(0) vec4<f32> {
    return textureSampleLevel(color, color_sampler, in.uv + vec2<f32>(2.0, 3.0) / vec2<f32>(61.0, 43.0), 0.0);
}
";

/// Clip space of Vulkan has +y down. Its block turns the picture or leaves it.
const VERT: &str = r"#version 450
layout(location = 1) out vec2 uv;
layout(set = 2, binding = 5) uniform Turn { float side; } turn;

void main() {
    vec2 place = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);
    gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
    uv = turn.side > 0.0 ? place : 1.0 - place;
}
";

const FRAG: &str = r"#version 450
layout(location = 1) in vec2 uv;
layout(location = 0) out vec4 result;
layout(set = 0, binding = 0) uniform sampler2D color;

void main() {
    result = textureLod(color, uv + vec2(2.0, 3.0) / vec2(61.0, 43.0), 0.0);
}
";

/// Clip space of HLSL has +y up.
const HLSL: &str = r"
Texture2D<float4> color : register(t0);
SamplerState color_sampler : register(s0);

struct Corner
{
    float4 position : SV_POSITION;
    float2 uv : TEXCOORD0;
};

Corner corners(uint index : SV_VertexID)
{
    Corner corner;
    corner.uv = float2((index << 1) & 2, index & 2);
    corner.position = float4(2.0 * corner.uv.x - 1.0, 1.0 - 2.0 * corner.uv.y, 0.0, 1.0);
    return corner;
}

float4 shade(Corner corner) : SV_Target
{
    return color.SampleLevel(color_sampler, corner.uv + float2(2.0, 3.0) / float2(61.0, 43.0), 0.0);
}
";

const SAMPLED: &str = "[[pass.binding]]\nname = \"color_sampler\"\nsampler = \"nearest\"\n";

const WGSL_PASS: &str =
    "[[pass]]\nshader = \"draw.wgsl\"\nstage = \"fragment\"\nvertex = \"full_screen\"\n";

const GLSL_PASS: &str = "[[pass]]\nshader = \"draw.frag\"\nvertex_shader = \"corner.vert\"\n\
                         [[pass.binding]]\nbinding = 0\ntexture = \"color\"\nsampler = \"nearest\"\n\
                         [[pass.binding]]\nset = 2\nbinding = 5\nvalues = { side = 1 }\n";

const HLSL_PASS: &str = "[[pass]]\nshader = \"draw.hlsl\"\nentry = \"shade\"\nstage = \"fragment\"\nvertex = \"corners\"\n";

const FILES: [(&str, &str); 4] = [
    ("draw.wgsl", WGSL),
    ("corner.vert", VERT),
    ("draw.frag", FRAG),
    ("draw.hlsl", HLSL),
];

#[test]
fn a_vertex_stage_of_the_file_draws_as_the_program_s_own() {
    let picture = busy_picture();
    let own = WGSL_PASS.replace("vertex = \"full_screen\"\n", "");
    for pass in [
        &format!("{own}{SAMPLED}"),
        &format!("{WGSL_PASS}{SAMPLED}"),
        GLSL_PASS,
        &format!("{HLSL_PASS}{SAMPLED}"),
    ] {
        let filter = make(pass, &FILES).unwrap();
        let output = blur(&filter, &filter.settings(None).unwrap(), &picture);
        for (x, y) in [(0, 0), (12, 9), (40, 30), (58, 39)] {
            assert_eq!(
                output.at(x, y),
                picture.color.at(x + 2, y + 3),
                "{pass} at ({x}, {y})"
            );
        }
    }
    // Values reach the blocks of the vertex stage.
    let turned = GLSL_PASS.replace("side = 1", "side = -1");
    let filter = make(&turned, &FILES).unwrap();
    let output = blur(&filter, &filter.settings(None).unwrap(), &picture);
    assert_eq!(output.at(12, 9), picture.color.at(60 - 12 + 2, 42 - 9 + 3));
    assert!(largest_difference(&output, &picture.color) > 0.5);
}

#[test]
fn wrong_vertex_stages_are_refused() {
    let wgsl = format!("{WGSL_PASS}{SAMPLED}");
    #[rustfmt::skip]
    assert_refused(&wgsl, &FILES, &[
        ("vertex = \"full_screen\"", "vertex = \"half_screen\"", &["draw.wgsl", "no vertex entry point \"half_screen\"", "full_screen (vertex), main (fragment)", "`vertex`"]),
        ("vertex = \"full_screen\"", "vertex = \"full screen\"", &["filter.toml:", "\"full screen\" is no name"]),
        ("vertex = \"full_screen\"", "vertex = \"full_screen\"\nvertex_shader = \"../draw.wgsl\"", &["filter.toml:", "vertex_shader: ", "no path within the filter's folder"]),
        ("vertex = \"full_screen\"", "vertex_shader = \"missing.wgsl\"", &["missing.wgsl", "cannot be read"]),
        ("stage = \"fragment\"\nvertex", "vertex", &["filter.toml:", "vertex and vertex_shader are for stage = \"fragment\""]),
        ("stage = \"fragment\"", "stage = \"vertex\"", &["filter.toml:", "unknown variant `vertex`"]),
    ]);
    let attributes = VERT.replace(
        "void main() {",
        "layout(location = 3) in vec2 corner;\nvoid main() {",
    );
    let attributes = attributes.replace(
        "vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2)",
        "corner",
    );
    let silent = VERT.replace("layout(location = 1) out vec2 uv;", "vec2 uv;");
    let textured = VERT.replace(
        "void main() {",
        "layout(set = 0, binding = 9) uniform sampler2D map;\nvoid main() {",
    );
    let textured = textured.replace(
        "uv = turn",
        "uv = texelFetch(map, ivec2(0), 0).xx; uv = turn",
    );
    #[rustfmt::skip]
    let cases: [(&str, &[&str]); 3] = [
        (&attributes, &["pass \"draw\"", "vertex shader \"main\" reads attributes at locations [3]", "no vertex buffers"]),
        (&silent, &["pass \"draw\"", "reads location 1", "writes locations []"]),
        (&textured, &["corner.vert", "is a texture of a vertex stage", "uniform blocks"]),
    ];
    for (vert, parts) in cases {
        let files = [("corner.vert", vert), ("draw.frag", FRAG)];
        assert_refused(GLSL_PASS, &files, &[("side = 1", "side = 1", parts)]);
    }
    #[rustfmt::skip]
    assert_refused(GLSL_PASS, &FILES, &[
        ("values = { side = 1 }", "", &["filter.toml:", "member \"side\" (f32 at byte 0) has no value"]),
        ("binding = 5", "binding = 6", &["filter.toml:", "nothing at group 2, binding 6", "group 2, binding 5"]),
    ]);
}
