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
