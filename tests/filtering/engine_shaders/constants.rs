//! Specialisation constants that parameters set.

use filters::{Blur, Filter, Kernels, Settings, Value, try_out};
use tests::open_gpu;
use tests::text::assert_contains;

use super::{assert_refused, blur, busy_picture, largest_difference, make};

/// Averages taps along the motion. Their number and the size of workgroups are constants.
const WGSL: &str = r"
override taps: i32 = 2;
@id(7) override side: u32 = 4;
@group(0) @binding(0) var color: texture_2d<f32>;
@group(0) @binding(1) var velocity: texture_2d<f32>;
@group(0) @binding(2) var output: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(side, side)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(color);
    if any(id.xy >= size) { return; }
    let trail = textureLoad(velocity, id.xy, 0).xy;
    var sum = vec4<f32>(0.0);
    for (var tap = 0; tap < taps; tap++) {
        let place = vec2<f32>(id.xy) + trail * f32(tap) / f32(taps);
        sum += textureLoad(color, clamp(vec2<i32>(place), vec2<i32>(0), vec2<i32>(size) - 1), 0);
    }
    textureStore(output, id.xy, sum / f32(taps));
}
";

const GLSL: &str = r"#version 450
layout(local_size_x_id = 5, local_size_y_id = 6) in;
layout(constant_id = 3) const int TAPS = 2;
layout(constant_id = 4) const bool IS_WHOLE = false;
const int LAST = TAPS - 1 + 0 * int(gl_WorkGroupSize.x);
layout(set = 0, binding = 0) uniform sampler2D color;
layout(set = 0, binding = 1) uniform sampler2D velocity;
layout(rgba32f, set = 0, binding = 2) uniform writeonly image2D picture;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(color, 0);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    vec2 trail = texelFetch(velocity, pixel, 0).xy * (IS_WHOLE ? 1.0 : 0.5);
    vec4 sum = vec4(0.0);
    for (int tap = 0; tap <= LAST; tap++) {
        vec2 place = vec2(pixel) + trail * float(tap) / float(TAPS);
        sum += texelFetch(color, clamp(ivec2(place), ivec2(0), size - 1), 0);
    }
    imageStore(picture, pixel, sum / float(TAPS));
}
";

const PARAMETERS: &str = r#"
[[parameter]]
name = "quality"
kind = "integer"
default = 1
range = [0, 4]
doc = "Taps, as a power of two."

[[parameter]]
name = "group"
kind = "integer"
default = 4
range = [2, 8]
doc = "Side of a workgroup, which changes no picture."

[[parameter]]
name = "reach"
kind = "choice"
choices = ["half", "whole"]
default = "whole"
doc = "Part of the motion."

[[preset]]
name = "low"
doc = "Two taps."

[[preset]]
name = "high"
doc = "Sixteen taps."
values = { quality = 4, group = 8 }
"#;

const WGSL_PASS: &str = "[[pass]]\nshader = \"taps.wgsl\"\nconstants = { taps = \"2 ^ quality\", 7 = \"group + 0 * reach\" }\n";

const GLSL_PASS: &str = "[[pass]]\nshader = \"taps.comp\"\nconstants = { TAPS = \"2 ^ quality\", 4 = \"reach\", 5 = \"group\", 6 = \"group\" }\n\
                         [[pass.binding]]\nbinding = 2\ntexture = \"output\"\n";

fn load(pass: &str) -> Filter {
    let files = [("taps.wgsl", WGSL), ("taps.comp", GLSL)];
    make(&format!("{PARAMETERS}{pass}"), &files).unwrap()
}

fn set(filter: &Filter, preset: &str, values: &[(&str, Value)]) -> Settings {
    let mut settings = filter.settings(Some(preset)).unwrap();
    for (name, value) in values {
        settings.set_value(filter, name, value.clone()).unwrap();
    }
    settings
}

#[test]
fn parameters_set_specialisation_constants_of_both_languages() {
    let picture = busy_picture();
    let (wgsl, glsl) = (load(WGSL_PASS), load(GLSL_PASS));
    let expected = |taps: i32| {
        // The shader's own values are set by numbers.
        let pass = format!("[[pass]]\nshader = \"taps.wgsl\"\nconstants = {{ taps = {taps} }}\n");
        let filter = make(&pass, &[("taps.wgsl", WGSL)]).unwrap();
        blur(&filter, &filter.settings(None).unwrap(), &picture)
    };
    for (preset, taps) in [("low", 2), ("high", 16)] {
        for filter in [&wgsl, &glsl] {
            let found = blur(filter, &set(filter, preset, &[]), &picture);
            let difference = largest_difference(&found, &expected(taps));
            assert!(difference < 1e-6, "{preset}: {difference}");
        }
    }
    let half = set(&glsl, "high", &[("reach", Value::Choice("half".into()))]);
    assert!(largest_difference(&blur(&glsl, &half, &picture), &expected(16)) > 0.1);
}

#[test]
fn compiled_kernels_serve_every_value() {
    let picture = busy_picture();
    let gpu = open_gpu();
    let filter = load(WGSL_PASS);
    let kernels = Kernels::compile(&gpu, &filter).unwrap();
    let colors = [&picture.color];
    let run = |quality: i32, group: i32| {
        let values = [
            ("quality", Value::Integer(quality)),
            ("group", Value::Integer(group)),
        ];
        let settings = set(&filter, "low", &values);
        let mut blur = Blur::with_kernels(&kernels, &settings, 61, 43).unwrap();
        blur.run(&picture.input(&colors)).unwrap().remove(0)
    };
    let pictures: Vec<_> = (0..5).map(|quality| run(quality, 4)).collect();
    // Again and in another order, with other workgroups, past the number of kernels that are kept.
    for group in 2..=8 {
        for quality in [4, 0, 2] {
            assert!(
                run(quality, group) == pictures[quality as usize],
                "{quality}, {group}"
            );
        }
    }
    assert!(pictures[1] != pictures[2] && pictures[0] == picture.color);
}

#[test]
fn constants_that_cannot_be_are_refused() {
    let declarations = format!("{PARAMETERS}{WGSL_PASS}");
    #[rustfmt::skip]
    assert_refused(&declarations, &[("taps.wgsl", WGSL)], &[
        ("2 ^ quality", "2 ^ width", &["filter.toml:", "constants: taps = \"2 ^ width\"", "unknown name \"width\"", "numbers, parameters"]),
        ("taps = \"2 ^ quality\"", "tabs = \"2 ^ quality\"", &["taps.wgsl", "no specialisation constant \"tabs\"", "it has: taps, side"]),
        ("\"2 ^ quality\"", "inf", &["filter.toml:", "constants: taps = inf; allowed: finite"]),
        ("\"2 ^ quality\"", "8", &["filter.toml:", "parameter \"quality\" changes nothing", "`constants`"]),
        ("\"2 ^ quality\"", "\"1e30 ^ quality\"", &["taps.wgsl", "specialisation constants: ", "fit"]),
    ]);
    // Values that only some settings have are tried where `list` tries the filter.
    let never = declarations.replace("group + 0 * reach", "group - 2 + 0 * reach");
    let filter = make(&never, &[("taps.wgsl", WGSL)]).unwrap();
    let refusal = try_out(&open_gpu(), &filter).unwrap_err().to_string();
    let parts = ["\"group\" = 2, the lower end of its range", "taps.wgsl"];
    assert_contains(&refusal, &parts);
}
