//! Limits of devices, and parameter ranges where a kernel fails.

use filters::{Filter, Limits, try_out};
use tests::open_gpu;
use tests::text::assert_contains;

use super::{list, load, refuse_rows, write_mine};
use crate::sandbox::{assert_done, assert_refused, stderr};

#[test]
fn list_tries_a_filter_and_lists_it_if_it_works() {
    let output = list(&write_mine(&[]));
    assert_done(&output);
    assert_eq!(stderr(&output), "");
}

#[test]
fn a_filter_that_the_device_refuses_is_refused_with_file_and_pass_before_anything_is_rendered() {
    for (sandbox, parts) in refuse_rows("device") {
        assert_refused(&sandbox.run(&["--filter", "mine"]), 2, &parts);
        assert!(!sandbox.path("out").exists());
    }
}

#[test]
fn list_finds_a_range_in_which_a_kernel_fails() {
    refuse_rows("ranges");
    if open_gpu().loop_limit.is_some() {
        let sandbox = write_mine(&[("[1, 64]", "[1, 100000]")]);
        let parts = ["parameter \"samples\" = 100000", "ends all loops"];
        assert_refused(&list(&sandbox), 2, &parts);
    }
}

/// Checks the filter, after these changes, against the lowest common limits.
fn check_lowest(changes: &[(&str, &str)]) -> Result<(), String> {
    let filter = load(&write_mine(changes)).unwrap();
    let checked = Limits::lowest().check(&filter);
    checked.map_err(|error| error.to_string())
}

#[test]
fn the_lowest_common_limits_hold_if_no_adapter_is_there() {
    let written = |names: &[&str]| {
        let [mut declared, mut stored, mut textures] = [(); 3].map(|()| String::new());
        for (index, name) in names.iter().enumerate() {
            let (at, texture) = (10 + index, "texture_storage_2d<rgba32float, write>");
            declared += &format!("@group(0) @binding({at}) var {name}_out: {texture};\n");
            stored += &format!("textureStore({name}_out, pixel, value);\n");
            textures += &format!("[[texture]]\nname = \"{name}\"\nformat = \"rgba32float\"\n");
        }
        let code = [
            ("// declarations", &declared[..]),
            ("// statements", &stored),
        ];
        check_lowest(&[code[0], code[1], ("[[pass]]", &(textures + "\n[[pass]]"))])
    };
    written(&["a", "b", "c"]).unwrap();
    let parts = "pass \"work\": 5 textures that it writes | allowed: at most 4 | lowest common limits | divide the pass";
    assert_contains(&written(&["a", "b", "c", "d"]).unwrap_err(), parts);
    check_lowest(&[("(8, 8)", "(16, 16)")]).unwrap();
    let binding = ("@binding(3)", "@binding(1000)");
    for (change, parts) in [
        (("(8, 8)", "(16, 17)"), "272 | allowed"),
        (("(8, 8)", "(1, 1, 65)"), "65 | allowed"),
        (binding, "1000 as a number of @binding | at most 999"),
    ] {
        assert_contains(&check_lowest(&[change]).unwrap_err(), parts);
    }
}

#[test]
fn variables_and_calls_too_large_for_any_device_are_refused_on_load() {
    let declared = "var<private> much: array<f32, 10000000>;";
    let used = "much[id.x] = value.x; value.x = much[id.y];";
    // Each function calls the previous one twice, which makes 2^60 calls.
    let mut functions = "fn f0_(a: f32) -> f32 { return a; }\n".to_owned();
    for (level, before) in (1..=60).zip(0..) {
        let twice = format!("f{before}_(a) + f{before}_(a + 1.0)");
        functions += &format!("fn f{level}_(a: f32) -> f32 {{ return {twice}; }}\n");
    }
    let much = "mine.wgsl:10 | bytes of variables | allowed: at most 16384";
    let calls = "mine.wgsl: | with every call inlined | at most 200000";
    for (declared, used, parts) in [
        (declared, used, much),
        (&functions, "value.x = f60_(value.x);", calls),
    ] {
        let changes = [("// declarations", declared), ("// statements", used)];
        assert_contains(&load(&write_mine(&changes)).unwrap_err(), parts);
    }
}

#[test]
fn every_built_in_filter_works_at_the_ends_of_its_ranges() {
    let gpu = open_gpu();
    for name in Filter::builtin_names() {
        let filter = Filter::builtin(&name).unwrap();
        try_out(&gpu, &filter).unwrap_or_else(|error| panic!("{error}"));
        let checked = Limits::lowest().check(&filter);
        checked.unwrap_or_else(|error| panic!("{error}"));
    }
}
