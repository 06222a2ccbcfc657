//! Limits of devices, and ranges in which a kernel fails.

use std::time::Instant;

use filters::{Filter, Limits, try_out};
use tests::open_gpu;
use tests::text::assert_contains;

use super::{change, list, load, write_mine};
use crate::sandbox::{assert_done, assert_refused, stderr};

#[test]
fn list_tries_a_filter_and_lists_it_if_it_works() {
    let sandbox = write_mine(&[]);
    let output = list(&sandbox);
    assert_done(&output);
    assert_eq!(stderr(&output), "");
}

#[test]
fn list_refuses_a_filter_that_the_device_refuses_with_file_and_pass() {
    #[rustfmt::skip]
    let wrong: &[(&str, &str, &[&str])] = &[
        ("(8, 8)", "(64, 64)", &["mine/mine.wgsl:10: pass \"work\"", "@workgroup_size(64, 64, 1): 4096 invocations", "allowed: at most", "smaller"]),
        ("(8, 8)", "(1, 1, 2000)", &["mine/mine.wgsl:10: pass \"work\"", "2000 invocations", "allowed: at most"]),
        ("// statements", "table[id.x] = value; value = table[id.y];", &["mine/mine.wgsl:10: pass \"work\"", "1600000 bytes of var<workgroup>", "allowed: at most"]),
        ("struct Parameters", "enable f16;\nstruct Parameters", &["mine/mine.wgsl:1:8", "f16"]),
        ("// declarations", "override size: u32 = 9;", &["mine/mine.wgsl:8", "override \"size\"", "const"]),
    ];
    for (from, to, parts) in wrong {
        let table = "var<workgroup> table: array<vec4<f32>, 100000>;";
        let sandbox = match to.starts_with("table") {
            true => write_mine(&[(from, to), ("// declarations", table)]),
            false => write_mine(&[(from, to)]),
        };
        assert_refused(&list(&sandbox), 2, parts);
        // Nothing was rendered before.
        assert_refused(&sandbox.run(&["--filter", "mine"]), 2, parts);
        assert!(!sandbox.path("out").exists());
    }
}

#[test]
fn the_lowest_common_limits_hold_if_no_adapter_is_there() {
    let written = |names: &[&str]| {
        let declared: String = (names.iter().enumerate())
            .map(|(index, name)| {
                let binding = 10 + index;
                format!("@group(0) @binding({binding}) var {name}_out: texture_storage_2d<rgba32float, write>;\n")
            })
            .collect();
        let stored: String = names
            .iter()
            .map(|name| format!("textureStore({name}_out, pixel, value);\n"))
            .collect();
        let textures: String = names
            .iter()
            .map(|name| format!("[[texture]]\nname = \"{name}\"\nformat = \"rgba32float\"\n"))
            .collect();
        let pass = format!("{textures}\n[[pass]]");
        let sandbox = write_mine(&[
            ("// declarations", &declared),
            ("// statements", &stored),
            ("[[pass]]", &pass),
        ]);
        let filter = load(&sandbox).unwrap();
        Limits::lowest()
            .check(&filter)
            .map_err(|error| error.to_string())
    };
    written(&["a", "b", "c"]).unwrap();
    assert_contains(
        &written(&["a", "b", "c", "d"]).unwrap_err(),
        &[
            "pass \"work\": 5 textures that it writes",
            "allowed: at most 4",
            "lowest common limits",
            "divide the pass",
        ],
    );
    let lowest = |from, to| {
        let filter = load(&write_mine(&[(from, to)])).unwrap();
        Limits::lowest()
            .check(&filter)
            .map_err(|error| error.to_string())
    };
    lowest("(8, 8)", "(16, 16)").unwrap();
    for (size, found) in [("(16, 17)", "272"), ("(1, 1, 65)", "65")] {
        assert_contains(&lowest("(8, 8)", size).unwrap_err(), &[found, "allowed"]);
    }
    assert_contains(
        &lowest("@binding(3)", "@binding(1000)").unwrap_err(),
        &["1000 as a number of @binding", "at most 999"],
    );
}

#[test]
fn variables_and_calls_too_large_for_any_device_are_refused_on_load() {
    let sandbox = write_mine(&[
        (
            "// declarations",
            "var<private> much: array<f32, 10000000>;",
        ),
        (
            "// statements",
            "much[id.x] = value.x; value.x = much[id.y];",
        ),
    ]);
    let parts = [
        "mine.wgsl:10",
        "bytes of variables",
        "allowed: at most 16384",
    ];
    assert_contains(&load(&sandbox).unwrap_err(), &parts);
    // Each function calls the previous one twice, which makes 2^60 calls.
    let twice: String = (1..=60)
        .map(|level| {
            let before = level - 1;
            format!(
                "fn f{level}_(a: f32) -> f32 {{ return f{before}_(a) + f{before}_(a + 1.0); }}\n"
            )
        })
        .collect();
    let functions = format!("fn f0_(a: f32) -> f32 {{ return a; }}\n{twice}");
    change(
        &sandbox,
        &[
            ("// declarations", &functions),
            ("// statements", "value.x = f60_(value.x);"),
        ],
    );
    assert_contains(
        &load(&sandbox).unwrap_err(),
        &["mine.wgsl:", "with every call inlined", "at most 200000"],
    );
}

#[test]
fn list_finds_a_range_in_which_a_kernel_fails() {
    #[rustfmt::skip]
    let wrong: &[(&str, &str, &[&str])] = &[
        ("[1, 64]", "[0, 64]", &["mine/filter.toml:5: parameter \"samples\" = 0, the lower end of its range, with preset \"plain\"", "pass work", "NaN", "pixel (0, 0)", "narrow the range"]),
        ("[0.5, 2.0]", "[0.5, 1e38]", &["filter.toml:12: parameter \"gain\" = 100000000000000000000000000000000000000, the upper end", "inf", "finite"]),
        ("// statements", "if parameters.samples == 64 { return; }", &["parameter \"samples\" = 64, the upper end", "pixel (0, 0) of the output unwritten"]),
        ("[[pass]]", "[[preset]]\nname = \"dark\"\ndoc = \"d\"\nvalues = { samples = 0 }\n[[pass]]", &["preset \"dark\" fails", "NaN"]),
    ];
    for (from, to, parts) in wrong {
        let mut changes = vec![(*from, *to)];
        if to.contains("dark") {
            changes.push(("[1, 64]", "[0, 64]"));
        }
        assert_refused(&list(&write_mine(&changes)), 2, parts);
    }
    let gpu = open_gpu();
    if gpu.loop_limit.is_some() {
        let sandbox = write_mine(&[("[1, 64]", "[1, 100000]")]);
        let parts = ["parameter \"samples\" = 100000", "ends all loops"];
        assert_refused(&list(&sandbox), 2, &parts);
    }
}

#[test]
fn every_built_in_filter_works_at_the_ends_of_its_ranges() {
    let gpu = open_gpu();
    for name in Filter::builtin_names() {
        let filter = Filter::builtin(&name).unwrap();
        let start = Instant::now();
        try_out(&gpu, &filter).unwrap_or_else(|error| panic!("{error}"));
        println!("{name}: {:.2} s", start.elapsed().as_secs_f64());
        Limits::lowest()
            .check(&filter)
            .unwrap_or_else(|error| panic!("{error}"));
    }
}
