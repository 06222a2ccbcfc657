//! Specialisation constants set by parameters.

use filters::{Blur, Filter, Kernels, Settings, Value, try_out};
use tests::near::assert_within;
use tests::shared_gpu;
use tests::text::assert_contains;

use super::{blur, blur_busy, busy_picture, largest_difference, make};
use crate::filter_files::FilterFiles;

const WGSL_PASS: &str = "[[pass]]\nshader = \"taps.wgsl\"\nconstants = { taps = \"2 ^ quality\", 7 = \"group + 0 * reach\" }\n";

const GLSL_PASS: &str = "[[pass]]\nshader = \"taps.comp\"\nconstants = { TAPS = \"2 ^ quality\", 4 = \"reach\", 5 = \"group\", 6 = \"group\" }\n\
                         [[pass.binding]]\nbinding = 2\ntexture = \"output\"\n";

fn declare(pass: &str) -> FilterFiles {
    let parameters = FilterFiles::fixture("filters/constants").text("parameters.toml");
    make("constants", &format!("{parameters}{pass}"))
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
    let [wgsl, glsl] = [WGSL_PASS, GLSL_PASS].map(|pass| declare(pass).load().unwrap());
    let expected = |taps: i32| {
        // The shader's own values are set by numbers.
        let pass = format!("[[pass]]\nshader = \"taps.wgsl\"\nconstants = {{ taps = {taps} }}\n");
        blur_busy(&make("constants", &pass))
    };
    for (preset, taps) in [("low", 2), ("high", 16)] {
        for filter in [&wgsl, &glsl] {
            let actual = blur(filter, &set(filter, preset, &[]), &picture);
            assert_within(largest_difference(&actual, &expected(taps)), ..1e-6);
        }
    }
    let half = set(&glsl, "high", &[("reach", Value::Choice("half".into()))]);
    assert!(largest_difference(&blur(&glsl, &half, &picture), &expected(16)) > 0.1);
}

#[test]
fn compiled_kernels_serve_every_value() {
    let picture = busy_picture();
    let filter = declare(WGSL_PASS).load().unwrap();
    let kernels = Kernels::compile(shared_gpu(), &filter).unwrap();
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
            let is_same = run(quality, group) == pictures[quality as usize];
            assert!(is_same, "{quality}, {group}");
        }
    }
    assert!(pictures[1] != pictures[2] && pictures[0] == picture.color);
}

#[test]
fn constants_that_cannot_be_are_refused() {
    let files = declare(WGSL_PASS);
    files.assert_refused("constants");
    // Values that only some settings have are tried when `list` tries the filter.
    let never = files.changed("filter.toml", "group + 0 * reach", "group - 2 + 0 * reach");
    let refusal = try_out(shared_gpu(), &never.load().unwrap()).unwrap_err();
    let parts = ["\"group\" = 2, the lower end of its range", "taps.wgsl"];
    assert_contains(&refusal.to_string(), &parts);
}

/// A shader of Godot, which marks its sections and the place of its macros, and one in HLSL.
const DEFINED: [(&str, &str); 2] = [
    (
        "shader = \"defined.comp\"\ndefines = { FACTOR = 1.5, OFFSET = \"ivec2(2, 3)\", FLAG = \"\" }\n",
        "[[pass.binding]]\nbinding = 1\ntexture = \"output\"\n",
    ),
    (
        "shader = \"defined.hlsl\"\nstage = \"fragment\"\ndefines = { FACTOR = 3.0, OFFSET = \"int2(2, 3)\", FLAG = \"/ 2\" }\n",
        "",
    ),
];

#[test]
fn macros_reach_the_compilers_of_glsl_and_hlsl() {
    let color = busy_picture().color;
    for (pass, bindings) in DEFINED {
        let output = blur_busy(&make("constants", &format!("[[pass]]\n{pass}{bindings}")));
        for (x, y) in [(3, 5), (12, 9), (40, 30)] {
            let due = color.at(x + 2, y + 3).map(|part| 1.5 * part);
            // Compilers may turn 3 / 2 x into 3 x 0.5 x.
            let apart = (output.at(x, y).iter().zip(due)).map(|(actual, due)| (actual - due).abs());
            assert_within(apart.fold(0.0, f32::max), ..1e-5);
        }
    }
}

#[test]
fn macros_without_a_name_or_a_compiler_are_refused() {
    let [(pass, bindings), _] = DEFINED;
    let files = make("constants", &format!("[[pass]]\n{pass}{bindings}"));
    files.assert_refused("defines");
}

#[test]
fn an_infinite_constant_becomes_the_largest_float() {
    let [(pass, bindings), _] = DEFINED;
    let files = make("constants", &format!("[[pass]]\n{pass}{bindings}"));
    let above = "float(texelFetch(color, pixel, 0).x > -1.0 / 0.0) * factor() *";
    let infinite = files.changed("defined.comp", "factor() *", above);
    assert_eq!(blur_busy(&infinite), blur_busy(&files));
}
