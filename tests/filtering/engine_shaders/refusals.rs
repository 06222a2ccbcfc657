//! Wrong bindings, wrong shaders and missing compilers, each refused with its place and the remedy.

use tests::text::assert_contains;

use super::{make, with_passes};

const PASSES: &str = include_str!("../../fixtures/shaders/passes.toml");

#[test]
fn wrong_bindings_are_refused_with_place_and_reason() {
    with_passes(PASSES).assert_refused("bindings");
}

#[test]
fn wrong_shaders_are_refused_with_file_line_and_reason() {
    with_passes(PASSES).assert_refused("shaders");
}

#[test]
fn push_constants_that_are_too_large_are_refused() {
    let shader = "#version 450\nlayout(local_size_x = 8) in;\nlayout(rgba32f, binding = 0) uniform writeonly image2D picture;\n\
                  layout(push_constant) uniform Params { MEMBERS } params;\n\
                  void main() { imageStore(picture, ivec2(gl_GlobalInvocationID.xy), vec4(params.last)); }\n";
    let declarations = "[[pass]]\nshader = \"large.comp\"\n[[pass.binding]]\nbinding = 0\ntexture = \"output\"\n\
                        [[pass.binding]]\npush_constants = true\nvalues = { \"*\" = 0 }\n";
    let files = make("camera", declarations).with("large.comp", shader);
    files.assert_refused("push_constants");
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
