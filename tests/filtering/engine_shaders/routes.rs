//! One blur by every route: the pictures are the same.

use std::fs;
use std::process::Command;

use filters::Filter;
use tests::filter_folder::load_filter;

use super::super::folders::example;
use super::{blur, busy_picture, fixtures, largest_difference, load, write_folder};

const PASSES: &str = include_str!("../../fixtures/shaders/passes.toml");

/// Difference between a sampler and the same interpolation by hand.
const ROUNDING: f32 = 1e-5;

/// Asserts that a filter blurs as the documented example in WGSL does, with each preset.
fn assert_same(filter: &Filter) {
    let wgsl = load_filter("centre_blur", example("toml"), example("wgsl")).unwrap();
    let picture = busy_picture();
    for preset in ["fast", "fine"] {
        let [expected, found] = [&wgsl, filter].map(|filter| {
            let settings = filter.settings(Some(preset)).unwrap();
            blur(filter, &settings, &picture)
        });
        let moved = largest_difference(&expected, &picture.color);
        assert!(
            moved > 0.5,
            "{preset}: the picture has something to blur: {moved}"
        );
        let difference = largest_difference(&expected, &found);
        assert!(difference < ROUNDING, "{preset}: {difference}");
    }
}

#[test]
fn glsl_with_bindings_of_its_own_blurs_as_wgsl_does() {
    assert_same(&load(PASSES, &["fastest.comp", "gather.comp"]).unwrap());
}

#[test]
fn spir_v_blurs_as_the_glsl_that_it_was_made_from() {
    let folder = tempfile::tempdir().unwrap();
    let passes = PASSES.replace(".comp", ".spv");
    write_folder(folder.path(), &passes, &[]);
    for name in ["fastest", "gather"] {
        let text = fs::read_to_string(fixtures().join(format!("{name}.comp"))).unwrap();
        let glsl = folder.path().join(format!("{name}.comp"));
        fs::write(&glsl, text.replace("#[compute]", "")).unwrap();
        let compiled = Command::new("glslangValidator")
            .args(["-V", "-o"])
            .arg(folder.path().join(format!("{name}.spv")))
            .arg(&glsl)
            .output()
            .expect("glslangValidator is installed: apt-get install glslang-tools");
        assert!(compiled.status.success(), "{compiled:?}");
    }
    assert_same(&Filter::load(folder.path()).unwrap());
}

/// The modules are what slangc 2026.14.1 makes of centre_blur.slang: with images that have no format, and fetches without a level.
#[test]
fn spir_v_of_slang_blurs_as_wgsl_does() {
    let mut passes = include_str!("../../fixtures/shaders/slang.toml").to_owned();
    for name in ["fastest", "gather"] {
        passes = passes.replacen("centre_blur.slang", &format!("slang_{name}.spv"), 1);
    }
    assert_same(&load(&passes, &["slang_fastest.spv", "slang_gather.spv"]).unwrap());
}

#[test]
fn specialisation_constants_have_the_values_of_filter_toml() {
    let folder = tempfile::tempdir().unwrap();
    let load = |constants: &str| {
        let pass = format!("shader = \"gather.comp\"\nconstants = {{ {constants} }}");
        let passes = PASSES.replace("shader = \"gather.comp\"", &pass);
        write_folder(folder.path(), &passes, &["fastest.comp"]);
        let text = fs::read_to_string(fixtures().join("gather.comp")).unwrap();
        let constant = "layout(constant_id = 4) const int TAPS = 3;\nvoid main() {";
        let text = (text.replace("void main() {", constant))
            .replace("int(settings.shutter_side_samples.z)", "TAPS");
        fs::write(folder.path().join("gather.comp"), text).unwrap();
        Filter::load(folder.path())
    };
    let picture = busy_picture();
    let pictures = ["", "TAPS = 3", "TAPS = 8", "4 = 8"].map(|constants| {
        let filter = load(constants).unwrap();
        blur(&filter, &filter.settings(None).unwrap(), &picture)
    });
    assert!(pictures[0] == pictures[1], "the shader's own value is 3");
    assert!(pictures[1] != pictures[2], "filter.toml sets another");
    assert!(pictures[2] == pictures[3], "4 is the number of TAPS");
    let message = load("SAMPLES = 8").unwrap_err().to_string();
    assert!(
        message.contains("no specialisation constant \"SAMPLES\"")
            && message.contains("it has: TAPS"),
        "{message}"
    );
}

#[test]
fn the_guide_s_shader_of_godot_s_kind_blurs_as_the_guide_s_kernel_does() {
    let guide = include_str!("../../../docs/add-a-filter.md");
    // Returns the block of code after a sentence.
    let block = |sentence: &str| {
        let after = guide.split_once(sentence).unwrap().1;
        let block = after.split_once("```").unwrap().1;
        let text = block.split_once('\n').unwrap().1;
        text.split_once("```").unwrap().0
    };
    let kernel = load_filter(
        "my_blur",
        block("`my_blur/filter.toml` says what it is:"),
        block("`my_blur/my_blur.wgsl` says what it does:"),
    );
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let manifest = block("`godot_blur/filter.toml` says what its bindings are:");
    write("filter.toml", manifest);
    write(
        "blur.glsl",
        block("`godot_blur/blur.glsl` is a shader of Godot's kind:"),
    );
    let godot = Filter::load(folder.path());
    let picture = busy_picture();
    let [expected, found] = [kernel, godot].map(|filter| {
        let filter = filter.unwrap();
        blur(&filter, &filter.settings(None).unwrap(), &picture)
    });
    let difference = largest_difference(&expected, &found);
    // Halves have 11 binary digits: 0.003 of 7 pixels, where neighbours differ by up to 2.5, and 0.001 of colours below 4.
    assert!(difference > 0.0 && difference < 0.02, "{difference}");
}
