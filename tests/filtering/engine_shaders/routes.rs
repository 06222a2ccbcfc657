//! One blur by every route, with equal pictures; wrong bindings and shaders, each refused with its
//! place and the remedy.

use std::fs;
use std::process::Command;

use tests::text::assert_contains;

use super::{assert_as_documented, make, with_passes};

const PASSES: &str = include_str!("../../fixtures/shaders/passes.toml");

/// Difference between a sampler and the same interpolation by hand.
const ROUNDING: f32 = 1e-5;

#[test]
fn glsl_with_bindings_of_its_own_blurs_as_wgsl_does() {
    assert_as_documented(&with_passes(PASSES).load().unwrap(), ROUNDING);
}

#[test]
fn spir_v_blurs_as_the_glsl_that_it_was_made_from() {
    let folder = tempfile::tempdir().unwrap();
    let mut files = with_passes(&PASSES.replace(".comp", ".spv"));
    for name in ["fastest", "gather"] {
        let [glsl, module] =
            ["comp", "spv"].map(|extension| folder.path().join(name).with_extension(extension));
        let text = files.text(&format!("{name}.comp"));
        fs::write(&glsl, text.replace("#[compute]", "")).unwrap();
        let compiled = Command::new("glslangValidator")
            .args(["-V", "-o"])
            .args([&module, &glsl])
            .output()
            .expect("glslangValidator is installed: apt-get install glslang-tools");
        assert!(compiled.status.success(), "{compiled:?}");
        files = files.with(&format!("{name}.spv"), fs::read(&module).unwrap());
    }
    assert_as_documented(&files.load().unwrap(), ROUNDING);
}

/// The modules are slangc 2026.14.1's output for centre_blur.slang: with images without a format,
/// and fetches without a level.
#[test]
fn spir_v_of_slang_blurs_as_wgsl_does() {
    let mut passes = include_str!("../../fixtures/shaders/slang.toml").to_owned();
    for name in ["fastest", "gather"] {
        passes = passes.replacen("centre_blur.slang", &format!("slang_{name}.spv"), 1);
    }
    assert_as_documented(&with_passes(&passes).load().unwrap(), ROUNDING);
}

#[test]
fn wrong_bindings_are_refused_with_place_and_reason() {
    with_passes(PASSES).assert_refused("bindings");
}

#[test]
fn wrong_shaders_are_refused_with_file_line_and_reason() {
    // The first pass is a module, so that each refusal starts one compiler.
    let module = include_str!("../../fixtures/shaders/slang.toml");
    let module = module.replacen("centre_blur.slang", "slang_fastest.spv", 1);
    let [fastest, gather] = [split_passes(&module)[0], split_passes(PASSES)[1]];
    let files = with_passes(&format!("{fastest}{gather}"));
    files.load().unwrap();
    files.assert_refused("shaders");
}

/// Returns the first pass, and the second.
fn split_passes(passes: &str) -> [&str; 2] {
    let second = passes.rfind("[[pass]]").unwrap();
    passes.split_at(second).into()
}

#[test]
fn push_constants_that_are_too_large_are_refused() {
    let declarations = "[[pass]]\nshader = \"large.comp\"\n[[pass.binding]]\nbinding = 0\ntexture = \"output\"\n\
                        [[pass.binding]]\npush_constants = true\nvalues = { \"*\" = 0 }\n";
    make("camera", declarations).assert_refused("push_constants");
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
