//! Wrong bindings, wrong shaders and missing compilers, each refused with its place and the remedy.

use tests::text::assert_contains;

use super::{make, with_passes};

const PASSES: &str = include_str!("../../fixtures/shaders/passes.toml");

#[test]
fn wrong_bindings_are_refused_with_place_and_reason() {
    #[rustfmt::skip]
    with_passes(PASSES).assert_refused("filter.toml", &[
        ("fastest.comp", "missing.comp", &["missing.comp", "cannot be read", "the shaders that its passes name"]),
        ("fastest.comp", "fastest.cpp", &["filter.toml:42:", "fastest.cpp", ".spv, .glsl"]),
        ("fastest.comp", "../fastest.comp", &["filter.toml:42:", "no path within the filter's folder"]),
        ("shader = \"fastest.comp\"", "entry = \"fastest\"\nstage = \"compute\"", &["filter.toml:41:", "stage is for a pass with `shader`"]),
        ("shader = \"fastest.comp\"", "shader = \"fastest.comp\"\nentry = \"start\"", &["fastest.comp", "no compute entry point \"start\"", "main (compute)"]),
        ("shader = \"fastest.comp\"", "shader = \"fastest.comp\"\nentry = \"main -o /tmp/x\"", &["filter.toml:42:", "\"main -o /tmp/x\" is no name"]),
        ("shader = \"fastest.comp\"", "shader = \"fastest.comp\"\ntargets = [\"output\"]", &["filter.toml:41:", "targets are for stage = \"fragment\""]),
        ("shader = \"fastest.comp\"", "shader = \"fastest.comp\"\nconditions = [\"FAST\"]", &["conditions are for WESL"]),
        ("set = 1\nbinding = 3\n", "set = 1\nbinding = 4\n", &["filter.toml:50:", "has nothing at group 1, binding 4", "\"motion\" at group 0, binding 0; \"params\" at push constants; \"tiles\" at group 1, binding 3"]),
        ("set = 1\nbinding = 3\ntexture = \"tile_motion\"\n", "set = 1\nbinding = 3\n", &["filter.toml:50:", "\"tiles\" at group 1, binding 3", "has no `texture`", "color, velocity, depth, output, tile_motion"]),
        ("texture = \"velocity\"", "texture = \"motion\"", &["filter.toml:45:", "\"motion\" names none", "color, velocity, depth, output, tile_motion"]),
        ("texture = \"velocity\"", "texture = \"output\"", &["filter.toml:45:", "reads \"output\""]),
        ("texture = \"output\"", "texture = \"color\"", &["writes \"color\", which is an input"]),
        ("texture = \"output\"", "texture = \"tile_motion\"", &["writes texture \"tile_motion\" as rgba32float", "declared as rg32float"]),
        ("sampler = \"nearest\"", "sampler = \"cubic\"", &["filter.toml:48:", "cubic", "nearest", "linear"]),
        ("push_constants = true", "push_constants = true\nbinding = 2", &["needs one of `binding` with its number"]),
        ("[[pass.binding]]\nbinding = 0\ntexture = \"color\"", "[[pass.binding]]\nbinding = 0\ntexture = \"color\"\n[[pass.binding]]\nbinding = 0\ntexture = \"color\"", &["group 0, binding 0 is explained twice"]),
        ("side = \"tile_size\", ", "", &["filter.toml:55:", "member \"side\" (i32 at byte 8) has no value", "exposure"]),
        ("side = \"tile_size\"", "side = \"tile\"", &["filter.toml:55:", "side = \"tile\" holds the unknown name \"tile\"", "samples, tile_size, spacing, width"]),
        ("unused = 0", "unsued = 0", &["member \"unused\" (f32 at byte 12) has no value"]),
        ("unused = 0", "unused = 0, more = 1", &["\"more\", which is no member", "picture, side, unused"]),
        ("noisy = \"spacing\"", "noisy = 0", &["filter.toml:", "parameter \"spacing\" changes nothing"]),
        ("picture = [\"width\", \"height\"]", "picture = [1, 2, 3]", &["member \"picture\" holds 2 x i32", "has 3"]),
        ("picture = [\"width\", \"height\"]", "picture = [1, [2]]", &["a value is a number"]),
        ("shader = \"gather.comp\"\n", "shader = \"gather.comp\"\nstage = \"fragment\"\n", &["gather.comp"]),
    ]);
}

#[test]
fn wrong_shaders_are_refused_with_file_line_and_reason() {
    #[rustfmt::skip]
    with_passes(PASSES).assert_refused("gather.comp", &[
        ("settings.turned", "settings.turn", &["gather.comp:30: glslangValidator refuses it", "gather.comp:30: 'turn'"]),
        ("void main()", "void main(", &["gather.comp:", "glslangValidator refuses it", "syntax error"]),
        ("rgba32f, set = 0, binding = 2", "rgba8, set = 0, binding = 2", &["filter.toml:", "writes \"output\" as rgba8unorm", "rgba32float or rgba16float"]),
        ("rgba32f, set = 0, binding = 2", "rgba16ui, set = 0, binding = 2", &["gather.comp"]),
        ("imageStore(picture, pixel, mean);", "imageStore(picture, pixel, mean + imageLoad(picture, pixel));", &["group 0, binding 2 of", "reads \"output\"; a pass reads what an earlier one wrote"]),
        ("uniform sampler2D color;", "uniform sampler2D color[2];", &["gather.comp"]),
        ("uniform sampler2D color;", "uniform sampler3D color;", &["gather.comp"]),
        ("mat4 turned;", "mat4 turned;\n    mat2 spare;", &["gather.comp", "its SPIR-V cannot be read: unsupported matrix stride 16"]),
        ("bool noisy;", "double noisy;", &["gather.comp"]),
    ]);
}

#[test]
fn push_constants_that_are_too_large_are_refused() {
    let shader = "#version 450\nlayout(local_size_x = 8) in;\nlayout(rgba32f, binding = 0) uniform writeonly image2D picture;\n\
                  layout(push_constant) uniform Params { MEMBERS } params;\n\
                  void main() { imageStore(picture, ivec2(gl_GlobalInvocationID.xy), vec4(params.last)); }\n";
    let declarations = "[[pass]]\nshader = \"large.comp\"\n[[pass.binding]]\nbinding = 0\ntexture = \"output\"\n\
                        [[pass.binding]]\npush_constants = true\nvalues = { \"*\" = 0 }\n";
    #[rustfmt::skip]
    make("camera", declarations).with("large.comp", shader).assert_refused("large.comp", &[
        ("MEMBERS", "vec4 many[1024]; float last;", &["filter.toml:", "push constants", "more than 4096 numbers"]),
        ("MEMBERS", "layout(offset = 65536) float last;", &["filter.toml:", "push constants", "at most 65536"]),
    ]);
}

#[test]
fn a_module_that_is_cut_short_is_refused() {
    let files = with_passes("[[pass]]\nshader = \"blur.spv\"\n");
    let module = include_bytes!("../../fuzz/corpus/spirv/gather");
    for (bytes, says) in [
        (&module[..0], "no SPIR-V module"),
        (&module[..1001], "cut short"),
        (&module[..600], "blur.spv"),
        (&b"#version 450 layout(set = 0)"[..], "begins with"),
    ] {
        let error = files.clone().with("blur.spv", bytes).load().unwrap_err();
        assert_contains(&error.to_string(), &[says]);
    }
}
