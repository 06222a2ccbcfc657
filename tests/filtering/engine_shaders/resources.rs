//! Textures, images and uniforms as engines have them: packed formats, sides rounded down, images that are read and written,
//! variables without registers.

use filters::Blur;
use frame::Image;
use tests::open_gpu;
use tests::text::assert_contains;

use super::{assert_refused, blur, busy_picture, largest_difference, make};

/// Writes a filter with these declarations and files, and blurs the picture.
fn run(declarations: &str, files: &[(&str, &str)]) -> Image {
    let filter = make(declarations, files).unwrap();
    blur(&filter, &filter.settings(None).unwrap(), &busy_picture())
}

/// Draws the texture `kept` to the picture.
const SHOW: &str = r"
@group(0) @binding(0) var kept: texture_2d<f32>;

@fragment
fn main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(kept, vec2<i32>(position.xy), 0) / 0.3;
}
";

const PACK: &str = r"
@group(0) @binding(0) var color: texture_2d<f32>;

@fragment
fn main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return 0.3 * textureLoad(color, vec2<i32>(position.xy), 0);
}
";

#[test]
fn render_targets_of_10_bits_keep_10_bits() {
    // Colours go up to 2.5.
    for (format, error) in [
        ("rgba32float", 0.0..1e-5),
        // A step of 10 bits: llvmpipe rounds down.
        ("rgb10a2unorm", 1e-5..1.0 / 0.3 / 1023.0),
        ("rg11b10ufloat", 1e-5..2.5 / 32.0),
    ] {
        let declarations = format!(
            "[[texture]]\nname = \"kept\"\nformat = \"{format}\"\n\
             [[pass]]\nshader = \"pack.wgsl\"\nstage = \"fragment\"\ntargets = [\"kept\"]\n\
             [[pass]]\nshader = \"show.wgsl\"\nstage = \"fragment\"\n"
        );
        let shown = run(&declarations, &[("pack.wgsl", PACK), ("show.wgsl", SHOW)]);
        let difference = largest_difference(&shown, &busy_picture().color);
        assert!(error.contains(&difference), "{format}: {difference}");
    }
}

#[test]
fn storage_textures_keep_what_their_format_holds() {
    let store = r"#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D color;
layout(QUALIFIER, set = 0, binding = 1) uniform writeonly image2D kept;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, imageSize(kept)))) {
        imageStore(kept, pixel, vec4(0.3, 0.2, 0.1, 1.0) * texelFetch(color, pixel, 0));
    }
}
";
    let color = busy_picture().color;
    // (format, its name in GLSL, channels, largest error of values up to 0.75)
    for (format, qualifier, channels, error) in [
        ("r32float", "r32f", 1, 1e-6),
        ("rg32float", "rg32f", 2, 1e-6),
        ("rgba32float", "rgba32f", 3, 1e-6),
        ("r16float", "r16f", 1, 5e-4),
        ("rg16float", "rg16f", 2, 5e-4),
        ("rgba16float", "rgba16f", 3, 5e-4),
        ("r8unorm", "r8", 1, 1.0 / 255.0),
        ("rgba8unorm", "rgba8", 3, 1.0 / 255.0),
        ("rgb10a2unorm", "rgb10_a2", 3, 1.0 / 1023.0),
        ("rg11b10ufloat", "r11f_g11f_b10f", 3, 0.75 / 32.0),
    ] {
        let declarations = format!(
            "[[texture]]\nname = \"kept\"\nformat = \"{format}\"\n\
             [[pass]]\nshader = \"store.comp\"\nover = \"kept\"\n\
             [[pass.binding]]\nbinding = 0\nsampler = \"nearest\"\n\
             [[pass]]\nshader = \"show.wgsl\"\nstage = \"fragment\"\n"
        );
        let text = store.replace("QUALIFIER", qualifier);
        let shown = run(&declarations, &[("store.comp", &text), ("show.wgsl", SHOW)]);
        for (found, color) in shown.pixels.iter().zip(&color.pixels) {
            for channel in 0..channels {
                let expected = [0.3, 0.2, 0.1][channel] * color[channel];
                let difference = (0.3 * found[channel] - expected).abs();
                assert!(
                    difference <= error,
                    "{format}: {difference} in channel {channel}"
                );
            }
        }
    }
}

#[test]
fn samplers_clamp_repeat_or_mirror_and_interpolate_or_not() {
    let shader = r"
@group(0) @binding(0) var color: texture_2d<f32>;
@group(0) @binding(1) var own: sampler;

@fragment
fn main(@location(0) uv: vec2<f32>) -> @location(0) vec4<f32> {
    return textureSampleLevel(color, own, uv + vec2<f32>(10.25, 0.0) / 61.0, 0.0);
}
";
    let color = busy_picture().color;
    let gray = |x: u32| color.at(x, 5)[0];
    // (keys, value at column 3, value at column 55)
    for (keys, inside, beyond) in [
        ("sampler = \"nearest\"", gray(13), gray(60)),
        (
            "sampler = \"linear\"",
            0.75 * gray(13) + 0.25 * gray(14),
            gray(60),
        ),
        (
            "sampler = \"nearest\"\nwrap = \"repeat\"",
            gray(13),
            gray(4),
        ),
        (
            "sampler = \"nearest\"\nwrap = \"mirror\"",
            gray(13),
            gray(56),
        ),
    ] {
        let declarations = format!(
            "[[pass]]\nshader = \"sample.wgsl\"\nstage = \"fragment\"\n[[pass.binding]]\nbinding = 1\n{keys}\n"
        );
        let shown = run(&declarations, &[("sample.wgsl", shader)]);
        for (x, expected) in [(3, inside), (55, beyond)] {
            let found = shown.at(x, 5)[0];
            // Samplers have 8 binary digits between texels.
            let difference = (found - expected).abs();
            assert!(difference < 0.01, "{keys}: {found} at {x}, not {expected}");
        }
    }
}

#[test]
fn the_pass_that_writes_the_first_broken_value_is_named() {
    let declarations = "[[texture]]\nname = \"kept\"\nformat = \"rgba16float\"\n\
                        [[pass]]\nshader = \"pack.wgsl\"\nstage = \"fragment\"\ntargets = [\"kept\"]\n\
                        [[pass]]\nshader = \"show.wgsl\"\nstage = \"fragment\"\n";
    let broken = PACK.replace(
        "return 0.3",
        "return sqrt(f32(i32(position.x) - 7 + 8 * abs(i32(position.y) - 5))) * 0.3",
    );
    let filter = make(declarations, &[("pack.wgsl", &broken), ("show.wgsl", SHOW)]).unwrap();
    let picture = busy_picture();
    let gpu = open_gpu();
    let settings = filter.settings(None).unwrap();
    let mut blur = Blur::new(&gpu, &filter, &settings, 61, 43).unwrap();
    let colors = [&picture.color];
    let message = blur.run(&picture.input(&colors)).unwrap_err().to_string();
    let parts = [
        "pass show: writes [NaN, NaN, NaN] to pixel (0, 5)",
        "pass pack writes the first that is not, to texel (0, 5) of \"kept\"",
    ];
    assert_contains(&message, &parts);
}

#[test]
fn an_image_that_is_read_and_written_keeps_what_is_not_written() {
    let fill = r"
@group(0) @binding(0) var state: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(state, id.xy, vec4<f32>(f32(id.x), f32(id.y), 1.0, 1.0));
}
";
    // Each run changes every third column, by what its left neighbour holds.
    let step = r"#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f, set = 0, binding = 0) uniform image2D state;
layout(push_constant) uniform Params { int iteration; } params;

vec4 at(ivec2 pixel) {
    return imageLoad(state, pixel);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, imageSize(state))) && pixel.x % 3 == params.iteration) {
        imageStore(state, pixel, at(pixel) + 10.0 * at(max(pixel - ivec2(1, 0), ivec2(0))).zzzz);
    }
}
";
    let show = r"
@group(0) @binding(0) var state: texture_2d<f32>;

@fragment
fn main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(state, vec2<i32>(position.xy), 0);
}
";
    let declarations = "[[texture]]\nname = \"state\"\nformat = \"rgba16float\"\n\
                        [[pass]]\nshader = \"fill.wgsl\"\nover = \"state\"\n\
                        [[pass]]\nshader = \"step.comp\"\nover = \"state\"\nrepeat = 3\n\
                        [[pass]]\nshader = \"show.wgsl\"\nstage = \"fragment\"\n";
    let files = [
        ("fill.wgsl", fill),
        ("step.comp", step),
        ("show.wgsl", show),
    ];
    let shown = run(declarations, &files);
    let mut expected = vec![1.0_f32; 61];
    for iteration in 0..3 {
        let before = expected.clone();
        for x in (0..61).filter(|x| x % 3 == iteration) {
            expected[x] += 10.0 * before[x.saturating_sub(1)];
        }
    }
    for (x, expected) in (0..61).zip(expected) {
        let found = shown.at(x, 7)[2];
        // Halves have 11 binary digits, three times.
        assert!(
            (found / expected - 1.0).abs() < 2e-3,
            "{found} at {x}, not {expected}"
        );
    }
}

#[test]
fn hlsl_without_registers_is_bound_by_name() {
    let hlsl = r"
Texture2D<float4> _MainTex;
Texture2D<float4> _Motion;
SamplerState sampler_MainTex;
float4 _Unused;
float _Scale;
float4 _MainTex_TexelSize;

struct Corner
{
    float4 pos : SV_POSITION;
    float2 uv0 : TEXCOORD0;
    float2 uv1 : TEXCOORD1;
};

float4 frag(Corner i) : SV_Target
{
    float2 uv = i.uv0 + _MainTex_TexelSize.xy;
    float2 motion = _Motion.SampleLevel(sampler_MainTex, i.uv1, 0.0).xy;
    return _Scale * _MainTex.SampleLevel(sampler_MainTex, uv, 0.0) + float4(motion, 0.0, 0.0);
}
";
    let pass = "[[pass]]\nshader = \"blur.hlsl\"\nentry = \"frag\"\nstage = \"fragment\"\n\
                [[pass.binding]]\nname = \"_MainTex\"\ntexture = \"color\"\n\
                [[pass.binding]]\nname = \"_Motion\"\ntexture = \"velocity\"\n\
                [[pass.binding]]\nname = \"sampler_MainTex\"\nsampler = \"nearest\"\n\
                [[pass.binding]]\nglobals = true\n\
                values = { _Scale = \"max(min(exposure, 1), 0.5) + color_scale\", \"*\" = 0, \
                _MainTex_TexelSize = [\"1 / width\", 0, 0, 0] }\n";
    let found = run(pass, &[("blur.hlsl", hlsl)]);
    let picture = busy_picture();
    for (x, y) in [(12_u32, 9_u32), (40, 30), (5, 5)] {
        let [gray, ..] = *picture.color.at(x + 1, y);
        let motion = picture.velocity.at(x, y);
        let expected = [1.7 * gray + motion[0], 1.7 * gray + motion[1], 1.7 * gray];
        for (found, expected) in found.at(x, y).iter().zip(expected) {
            assert!((found - expected).abs() < 1e-4, "{found}, not {expected}");
        }
    }
    let missing = ["has nothing at \"_Velocity\"", "\"_Motion\" at group 0"];
    let change = ("name = \"_Motion\"", "name = \"_Velocity\"", &missing[..]);
    assert_refused(pass, &[("blur.hlsl", hlsl)], &[change]);
}
