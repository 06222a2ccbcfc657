//! Filters with colours of 16-bit floats: what they gather is measured in 32 bits.

use std::fs;

use metrics::Measured;
use suite::Case;

use crate::sandbox::{Sandbox, assert_done, stdout};

/// Scores that need weights which do not depend on colour.
const OF_WEIGHTS: [&str; 9] = [
    "lateral_growth",
    "row_loss",
    "bleed_lateral",
    "label_tv",
    "extent",
    "centroid",
    "unity",
    "gather_offset",
    "gather_spread",
];

/// A blur of two passes whose colours have FLOAT.
const MANIFEST: &str = "
name = \"NAME\"
summary = \"Averages what lies ahead.\"
alignment = \"trailing\"

[convention]
color_format = \"FLOAT\"

[[texture]]
name = \"between\"
format = \"FLOAT\"

[[pass]]
entry = \"copy\"

[[pass]]
entry = \"gather\"
";

const KERNELS: &str = "
@group(0) @binding(1) var color: texture_2d<f32>;
@group(0) @binding(2) var velocity: texture_2d<f32>;
@group(0) @binding(3) var between: texture_2d<f32>;
@group(0) @binding(4) var between_out: texture_storage_2d<FLOAT, write>;
@group(0) @binding(5) var output: texture_storage_2d<FLOAT, write>;

@compute @workgroup_size(8, 8)
fn copy(@builtin(global_invocation_id) id: vec3<u32>) {
    if inside(vec2<i32>(id.xy)) { textureStore(between_out, id.xy, textureLoad(color, id.xy, 0)); }
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) { return; }
    let trail = frame.exposure * textureLoad(velocity, pixel, 0).xy;
    var sum = vec4<f32>(0.0);
    var weights = 0.0;
    for (var tap = 0; tap < 7; tap++) {
        let there = bilinear(between, centre(pixel) + (f32(tap) + 0.5) / 7.0 * trail);
        let weight = WEIGHT;
        sum += weight * there;
        weights += weight;
    }
    textureStore(output, pixel, sum / weights);
}
";

fn write_blur(sandbox: &Sandbox, name: &str, float: &str, weight: &str) {
    let fill = |text: &str| text.replace("NAME", name).replace("FLOAT", float);
    let kernels = fill(KERNELS).replace("WEIGHT", weight);
    sandbox.write_filter(name, &fill(MANIFEST), &kernels);
}

fn reason_of(case: &Case, metric: &str) -> String {
    match case.scores.get(metric.parse().unwrap()) {
        Measured::NotApplicable { reason } => reason,
        found => panic!("{metric} of {}: {found:?}", case.name()),
    }
}

#[test]
fn rounded_colours_lose_no_score_of_what_a_filter_gathers() {
    let sandbox = Sandbox::new();
    write_blur(&sandbox, "full", "rgba32float", "1.0");
    write_blur(&sandbox, "half", "rgba16float", "1.0");
    assert_done(&sandbox.run(&["--filter", "full,half"]));
    let cases = sandbox.read_filter_cases();
    let [full, half] = &cases[..] else {
        panic!("two filters on one scene");
    };
    assert_eq!(half.nonlinearity, full.nonlinearity);
    for metric in OF_WEIGHTS.map(|name| name.parse().unwrap()) {
        let found = half.scores.get(metric);
        assert!(found.value().is_some(), "{}: {found:?}", metric.name());
        // The weights are the same, and so is what they gather.
        assert_eq!(found, full.scores.get(metric), "{}", metric.name());
    }
    // The picture is the filter's own.
    assert_ne!(half.scores.moving, full.scores.moving);
}

/// The guide's example of Godot's kind stores its output in 16 bits, and so do fragment shaders of many engines.
#[test]
fn shaders_of_engines_keep_their_scores_in_16_bits() {
    const GUIDE: &str = include_str!("../../docs/add-a-filter.md");
    let block = |start: &str| {
        let after = GUIDE.split_once(start).unwrap().1;
        after.split_once("```").unwrap().0
    };
    let sandbox = Sandbox::new();
    let godot = sandbox.path("godot_blur");
    fs::create_dir_all(&godot).unwrap();
    let manifest = block("`godot_blur/filter.toml` says what its bindings are:\n\n```toml\n");
    fs::write(godot.join("filter.toml"), manifest).unwrap();
    let shader = block("`godot_blur/blur.glsl` is a shader of Godot's kind:\n\n```glsl\n");
    fs::write(godot.join("blur.glsl"), shader).unwrap();
    let drawn = sandbox.path("drawn");
    fs::create_dir_all(&drawn).unwrap();
    let manifest = "name = 'drawn'\nsummary = 'A fragment shader.'\nalignment = 'trailing'\n\n\
         [convention]\ncolor_format = 'rgba16float'\noutput_format = 'rgba16float'\n\n\
         [[pass]]\nshader = 'draw.wgsl'\nstage = 'fragment'\n";
    fs::write(drawn.join("filter.toml"), manifest).unwrap();
    let shader = "@group(0) @binding(0) var color: texture_2d<f32>;\n\
         @group(0) @binding(1) var velocity: texture_2d<f32>;\n\
         @fragment\nfn main(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {\n\
         let last = vec2<i32>(textureDimensions(color)) - 1;\n\
         let pixel = vec2<i32>(at.xy);\n\
         let trail = textureLoad(velocity, pixel, 0).xy;\n\
         var sum = vec4<f32>(0.0);\n\
         for (var tap = 0; tap < 7; tap++) {\n\
         let there = vec2<i32>(at.xy + trail * 0.5 * (f32(tap) + 0.5) / 7.0);\n\
         sum += textureLoad(color, clamp(there, vec2<i32>(0), last), 0) / 7.0;\n}\n\
         return sum;\n}\n";
    fs::write(drawn.join("draw.wgsl"), shader).unwrap();
    assert_done(&sandbox.run(&["--filter", "godot_blur,drawn"]));
    let cases = sandbox.read_filter_cases();
    assert_eq!(cases.len(), 2);
    for case in &cases {
        for metric in OF_WEIGHTS {
            let found = case.scores.get(metric.parse().unwrap());
            assert!(
                found.value().is_some(),
                "{metric} of {}: {found:?}",
                case.name()
            );
        }
    }
}

/// A shader that is made again for other constants stores as the first does.
#[test]
fn shaders_of_other_constants_keep_their_scores_in_16_bits() {
    let sandbox = Sandbox::new();
    let folder = sandbox.path("constant");
    fs::create_dir_all(&folder).unwrap();
    let manifest = "name = 'constant'\nsummary = 'Constants.'\nalignment = 'trailing'\n\n\
         [convention]\ncolor_format = 'rgba16float'\n\n\
         [[parameter]]\nname = 'taps'\nkind = 'integer'\ndefault = 3\nrange = [1, 64]\ndoc = 'Taps.'\n\n\
         [[pass]]\nshader = 'blur.wgsl'\nconstants = { TAPS = 'taps' }\n";
    fs::write(folder.join("filter.toml"), manifest).unwrap();
    let shader = "override TAPS: i32 = 1;\n\
         @group(0) @binding(0) var color: texture_2d<f32>;\n\
         @group(0) @binding(1) var velocity: texture_2d<f32>;\n\
         @group(0) @binding(2) var output: texture_storage_2d<rgba16float, write>;\n\
         @compute @workgroup_size(8, 8)\nfn main(@builtin(global_invocation_id) id: vec3<u32>) {\n\
         let last = vec2<i32>(textureDimensions(color)) - 1;\nlet pixel = vec2<i32>(id.xy);\n\
         if any(pixel > last) { return; }\n\
         let trail = 0.5 * textureLoad(velocity, pixel, 0).xy;\n\
         var sum = vec4<f32>(0.0);\nfor (var tap = 0; tap < TAPS; tap++) {\n\
         let there = pixel + vec2<i32>(trail * f32(tap) / f32(TAPS));\n\
         sum += textureLoad(color, clamp(there, vec2<i32>(0), last), 0) / f32(TAPS);\n}\n\
         textureStore(output, pixel, sum);\n}\n";
    fs::write(folder.join("blur.wgsl"), shader).unwrap();
    assert_done(&sandbox.run(&["--filter", "constant", "--set", "constant.taps=7"]));
    let cases = sandbox.read_filter_cases();
    let nonlinearity = cases[0].nonlinearity.unwrap();
    // Half of a last digit of 32 bits is 6e-8, of 16 bits 5e-4.
    assert!(nonlinearity < 1e-4, "{nonlinearity}");
}

#[test]
fn weights_that_depend_on_colour_are_found_in_16_bits_too() {
    let sandbox = Sandbox::new();
    write_blur(&sandbox, "bright", "rgba16float", "1.0 + 0.5 * there.g");
    let output = sandbox.run(&["--filter", "bright", "--table"]);
    assert_done(&output);
    let table = stdout(&output);
    let table = table.split_whitespace().collect::<Vec<_>>().join(" ");
    let note = "n/a: grow, loss, bleed, TV of bright:default on plate: the filter's weights depend on colour";
    assert!(table.contains(note), "{table}");
    let cases = sandbox.read_filter_cases();
    for metric in OF_WEIGHTS {
        let reason = reason_of(&cases[0], metric);
        assert!(reason.contains("weights depend on colour"), "{reason}");
    }
}

/// The format of a program's picture is the program's own.
#[cfg(unix)]
#[test]
fn a_program_that_rounds_is_told_so() {
    let sandbox = Sandbox::new();
    write_blur(&sandbox, "half", "rgba16float", "1.0");
    let command = format!(
        "command = ['{}', 'engine', 'blur', '--filter', '{}', '--frame', '{{frame}}', '--out', '{{out}}', '--exposure', '{{exposure}}']",
        env!("CARGO_BIN_EXE_shuttertruth"),
        sandbox.path("half").display(),
    );
    tests::filter_folder::write_manifest(&sandbox.path("outside"), "outside", &command);
    assert_done(&sandbox.run(&["--filter", "outside", "--allow-commands"]));
    let cases = sandbox.read_filter_cases();
    for metric in OF_WEIGHTS {
        let reason = reason_of(&cases[0], metric);
        assert!(reason.contains("writes 16-bit floats"), "{reason}");
        assert!(reason.contains("let it write 32-bit floats"), "{reason}");
    }
}
