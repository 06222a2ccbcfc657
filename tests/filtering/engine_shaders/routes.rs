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
