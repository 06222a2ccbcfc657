//! One blur by every route, with equal pictures.

use std::fs;
use std::process::Command;

use super::{assert_as_documented, with_passes};

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
        let [glsl, module] = ["comp", "spv"].map(|it| folder.path().join(name).with_extension(it));
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

/// The modules are slangc 2026.14.1's output for centre_blur.slang: with images without a format, and fetches without a level.
#[test]
fn spir_v_of_slang_blurs_as_wgsl_does() {
    let mut passes = include_str!("../../fixtures/shaders/slang.toml").to_owned();
    for name in ["fastest", "gather"] {
        passes = passes.replacen("centre_blur.slang", &format!("slang_{name}.spv"), 1);
    }
    assert_as_documented(&with_passes(&passes).load().unwrap(), ROUNDING);
}
