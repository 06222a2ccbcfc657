//! Filter folders that no device could run, that fail within their own ranges, or that were made to break their readers.

use std::fs;
use std::process::Output;
use std::time::{Duration, Instant};

use filters::{Filter, Gpu, Limits, try_out};

use crate::bench::{Bench, assert_done, assert_refused, stderr};

const MANIFEST: &str = r#"name = "mine"
summary = "Averages a few samples."
alignment = "trailing"

[[parameter]]
name = "samples"
kind = "integer"
default = 4
range = [1, 64]
doc = "Taps."

[[parameter]]
name = "gain"
kind = "real"
default = 1.0
range = [0.5, 2.0]
doc = "Times as bright."

[[preset]]
name = "plain"
doc = "As it is."

[[pass]]
entry = "work"
"#;

const KERNELS: &str = "struct Parameters {
    samples: i32,
    gain: f32,
}
@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var output: texture_storage_2d<rgba32float, write>;
// declarations
@compute @workgroup_size(8, 8)
fn work(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) { return; }
    let here = textureLoad(color, pixel, 0);
    var value = vec4<f32>(0.0);
    for (var i = 0; i < parameters.samples; i++) {
        value += here;
    }
    // statements
    textureStore(output, pixel, parameters.gain * value / f32(parameters.samples));
}
";

/// A bench with the filter `mine`, some texts of which are replaced by others.
fn mine(changes: &[(&str, &str)]) -> Bench {
    let bench = Bench::new();
    change(&bench, changes);
    bench
}

fn change(bench: &Bench, changes: &[(&str, &str)]) {
    let (mut manifest, mut kernels) = (MANIFEST.to_owned(), KERNELS.to_owned());
    for (from, to) in changes {
        assert!(manifest.contains(from) || kernels.contains(from), "{from}");
        manifest = manifest.replacen(from, to, 1);
        kernels = kernels.replacen(from, to, 1);
    }
    fs::create_dir_all(bench.path("mine")).unwrap();
    fs::write(bench.path("mine/filter.toml"), manifest).unwrap();
    fs::write(bench.path("mine/mine.wgsl"), kernels).unwrap();
}

fn list(bench: &Bench) -> Output {
    bench.shuttertruth(&["list", "--filter", "mine"])
}

fn load(bench: &Bench) -> Result<Filter, String> {
    Filter::load(&bench.path("mine")).map_err(|error| error.to_string())
}

#[track_caller]
fn assert_says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(
            message.contains(part),
            "\"{part}\" is missing from: {message}"
        );
    }
}

#[test]
fn list_tries_a_filter_that_holds_and_says_so_by_listing_it() {
    let bench = mine(&[]);
    let output = list(&bench);
    assert_done(&output);
    assert_eq!(stderr(&output), "");
}

#[test]
fn what_the_device_refuses_is_refused_by_list_with_file_and_pass() {
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
        let bench = match to.starts_with("table") {
            true => mine(&[(from, to), ("// declarations", table)]),
            false => mine(&[(from, to)]),
        };
        assert_refused(&list(&bench), 2, parts);
        // Before anything is rendered.
        assert_refused(&bench.run(&["--filter", "mine"]), 2, parts);
        assert!(!bench.path("out").exists());
    }
}

#[test]
fn without_an_adapter_the_lowest_common_limits_hold() {
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
        let bench = mine(&[
            ("// declarations", &declared),
            ("// statements", &stored),
            ("[[pass]]", &pass),
        ]);
        let filter = load(&bench).unwrap();
        Limits::lowest()
            .check(&filter)
            .map_err(|error| error.to_string())
    };
    written(&["a", "b", "c"]).unwrap();
    assert_says(
        &written(&["a", "b", "c", "d"]).unwrap_err(),
        &[
            "pass \"work\": 5 textures that it writes",
            "allowed: at most 4",
            "lowest common limits",
            "divide the pass",
        ],
    );
    let lowest = |from, to| {
        let filter = load(&mine(&[(from, to)])).unwrap();
        Limits::lowest()
            .check(&filter)
            .map_err(|error| error.to_string())
    };
    lowest("(8, 8)", "(16, 16)").unwrap();
    for (size, found) in [("(16, 17)", "272"), ("(1, 1, 65)", "65")] {
        assert_says(&lowest("(8, 8)", size).unwrap_err(), &[found, "allowed"]);
    }
    assert_says(
        &lowest("@binding(3)", "@binding(1000)").unwrap_err(),
        &["1000 as a number of @binding", "at most 999"],
    );
}

#[test]
fn variables_and_calls_that_no_device_holds_are_refused_when_loaded() {
    let bench = mine(&[
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
    assert_says(&load(&bench).unwrap_err(), &parts);
    // Each function calls the one before it twice: 2^60 calls.
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
        &bench,
        &[
            ("// declarations", &functions),
            ("// statements", "value.x = f60_(value.x);"),
        ],
    );
    assert_says(
        &load(&bench).unwrap_err(),
        &["mine.wgsl:", "with every call inlined", "at most 200000"],
    );
}

#[test]
fn a_range_that_makes_a_kernel_fail_is_found_by_list() {
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
        assert_refused(&list(&mine(&changes)), 2, parts);
    }
    let gpu = Gpu::new(None).expect("this test runs filters");
    if gpu.loop_limit.is_some() {
        let bench = mine(&[("[1, 64]", "[1, 100000]")]);
        let parts = ["parameter \"samples\" = 100000", "ends all loops"];
        assert_refused(&list(&bench), 2, &parts);
    }
}

#[test]
fn every_built_in_filter_holds_at_the_ends_of_its_ranges() {
    let gpu = Gpu::new(None).expect("this test runs filters");
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

#[test]
fn deep_kernels_are_read_or_refused_with_their_line() {
    let sum = |terms: usize| format!("value.x = here.x{};", " + here.x".repeat(terms - 1));
    let choices = |count: usize| {
        let branches: String = (0..count)
            .map(|index| format!(" else if here.x > {index}.5 {{ value.x = {index}.0; }}"))
            .collect();
        format!("if here.x > 1e9 {{ }}{branches}")
    };
    let brackets =
        |count: usize| format!("value.x = {}1.0{};", "(".repeat(count), ")".repeat(count));
    // Each term counts two: a sum and a member.
    for statements in [sum(490), choices(300), brackets(150)] {
        let bench = mine(&[("// statements", &statements)]);
        assert_done(&list(&bench));
    }
    for statements in [
        sum(2_000),
        sum(10_000),
        sum(20_000),
        choices(2_000),
        choices(3_000),
        brackets(100_000),
    ] {
        let bench = mine(&[("// statements", &statements)]);
        let parts = [
            "mine.wgsl:18: more than 1000 operators",
            "allowed: at most 1000",
        ];
        assert_refused(&list(&bench), 2, &parts);
    }
    // Naga's own limits have a place too.
    let bench = mine(&[("// statements", &brackets(400))]);
    assert_refused(&list(&bench), 2, &["mine.wgsl"]);
    // Many declarations that refer to one another, and many statements.
    let mut constants = "const c0 = 1;\n".to_owned();
    for index in 1..10_000 {
        constants.insert_str(0, &format!("const c{index} = c{};\n", index - 1));
    }
    load(&mine(&[("// declarations", &constants)])).unwrap();
}

#[test]
fn only_regular_files_of_bounded_size_are_read() {
    let bench = mine(&[]);
    for (file, limit) in [("filter.toml", 1 << 20), ("mine.wgsl", 256 << 10)] {
        let path = bench.path("mine").join(file);
        let whole = fs::read(&path).unwrap();
        let mut large = whole.clone();
        large.resize(limit + 1, b'\n');
        fs::write(&path, &large).unwrap();
        let parts = [file, "holds", &format!("at most {limit} are read")];
        assert_refused(&list(&bench), 2, &parts);
        fs::write(&path, b"\xff\xfe").unwrap();
        assert_refused(&list(&bench), 2, &[file, "not UTF-8"]);
        fs::remove_file(&path).unwrap();
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("/dev/zero", &path).unwrap();
            assert_refused(&list(&bench), 2, &[file, "is a device"]);
            fs::remove_file(&path).unwrap();
            let made = std::process::Command::new("mkfifo").arg(&path).status();
            assert!(made.unwrap().success());
            assert_refused(&list(&bench), 2, &[file, "is a FIFO"]);
            fs::remove_file(&path).unwrap();
        }
        fs::create_dir(&path).unwrap();
        assert_refused(&list(&bench), 2, &[file, "is a folder"]);
        fs::remove_dir(&path).unwrap();
        fs::write(&path, whole).unwrap();
    }
    assert_done(&list(&bench));
}

#[test]
fn numbers_and_texts_that_nothing_can_hold_are_refused_with_their_line() {
    #[rustfmt::skip]
    let wrong: &[(&str, &str, &[&str])] = &[
        ("[0.5, 2.0]", "[0.5, 1e39]", &["filter.toml:12", "gain", "1e39", "no f32 holds"]),
        ("[0.5, 2.0]", "[1e-60, 2.0]", &["filter.toml:12", "gain", "1e-60", "no f32 holds"]),
        ("[0.5, 2.0]", "[nan, 2.0]", &["filter.toml:12", "gain", "NaN"]),
        ("[0.5, 2.0]", "[-inf, inf]", &["filter.toml:12", "gain", "finite"]),
        ("default = 1.0", "default = nan", &["filter.toml:12", "gain", "nan"]),
        ("[1, 64]", "[1, 1e18]", &["filter.toml:5", "samples", "32-bit"]),
        ("default = 4", "default = 99999999999999999999", &["filter.toml:8"]),
        ("entry = \"work\"", "entry = \"work\"\nrepeat = 4000000000", &["filter.toml:23", "pass \"work\"", "4000000000 times", "at most 4095"]),
        ("entry = \"work\"", "entry = \"work\"\nrepeat = -1", &["filter.toml:25", "repeat is a count from 1"]),
        ("alignment", "time_limit = inf\nalignment", &["filter.toml:3", "time_limit = inf", "allowed"]),
        ("few samples.", "few\\nsamples.", &["filter.toml:2", "summary holds the control character U+000A"]),
        ("few samples.", "few \\u001b[31msamples.", &["filter.toml:2", "U+001B"]),
        ("few samples.", "few ::error::samples.", &["filter.toml:2", "\"::error::samples.\""]),
        ("Taps.", "\\u009b31m", &["filter.toml:5", "parameter \"samples\": doc", "U+009B"]),
        ("As it is.", "As it is\\u202e.", &["filter.toml:19", "preset \"plain\": doc", "U+202E"]),
        ("name = \"mine\"", "name = \"mi\\u001bne\"", &["filter.toml:1", "a-z"]),
        ("name = \"mine\"", "name = \"../../etc/passwd\"", &["filter.toml:1", "a-z"]),
        ("name = \"gain\"", "name = \"\\n::error::x\"", &["filter.toml:12", "a-z"]),
        ("entry = \"work\"", "entry = \"wo\\u001brk\"", &["filter.toml:23", "entry holds the control character U+001B"]),
        ("kind = \"real\"\ndefault = 1.0\nrange = [0.5, 2.0]", "kind = \"choice\"\ndefault = \"a\"\nchoices = [\"a\", \"b\\n\"]", &["filter.toml:12", "choices", "U+000A"]),
        ("alignment", "\"\\u001b[31m\" = 1\nalignment", &["filter.toml:3", "unknown field"]),
        ("// statements", "value.x = \u{7}\u{1b}[31m;", &["mine.wgsl:18"]),
    ];
    for (from, to, parts) in wrong {
        let output = list(&mine(&[(from, to)]));
        assert_refused(&output, 2, parts);
        let message = stderr(&output);
        let raw = message.chars().find(|c| c.is_control() && *c != '\n');
        assert_eq!(raw, None, "{message:?}");
        let commands = message
            .lines()
            .any(|line| line.trim_start().starts_with("::"));
        assert!(!commands, "{message}");
    }
}

#[test]
fn thousands_of_presets_and_parameters_are_refused_in_no_time() {
    let start = Instant::now();
    let presets: String = (0..8_000)
        .map(|index| {
            format!("[[preset]]\nname = \"p{index}\"\ndoc = \"d\"\nvalues = {{ samples = 2 }}\n")
        })
        .collect();
    let bench = mine(&[("[[pass]]", &format!("{presets}[[pass]]"))]);
    assert_refused(&list(&bench), 2, &["8001 [[preset]]", "at most 256"]);
    let parameters: String = (0..8_000)
        .map(|index| format!("[[parameter]]\nname = \"p{index}\"\nkind = \"integer\"\ndefault = 1\nrange = [0, 2]\ndoc = \"d\"\n"))
        .collect();
    let bench = mine(&[("[[pass]]", &format!("{parameters}[[pass]]"))]);
    assert_refused(&list(&bench), 2, &["8002 [[parameter]]", "at most 256"]);
    assert!(start.elapsed() < Duration::from_secs(60));
}

#[test]
fn values_out_of_range_are_refused_before_anything_runs() {
    let bench = mine(&[]);
    for (value, parts) in [
        (
            "gain=nan",
            &["mine.gain: found nan", "a number from 0.5 to 2"],
        ),
        ("gain=inf", &["mine.gain: found inf", "allowed"]),
        ("gain=1e39", &["mine.gain: found 1e39", "allowed"]),
        ("gain=-0.6", &["mine.gain: found -0.6", "allowed"]),
        ("gain=", &["mine.gain: found ", "allowed"]),
        ("samples=65", &["mine.samples: found 65", "from 1 to 64"]),
        (
            "samples=99999999999",
            &["samples: found 99999999999", "allowed"],
        ),
        (
            "samples=2.5",
            &["mine.samples: found 2.5", "a whole number"],
        ),
        ("samples=1\u{1b}[31m", &["found 1\\u{1b}[31m", "allowed"]),
    ] {
        let set = format!("mine.{value}");
        let output = bench.run(&["--filter", "./mine", "--set", &set]);
        assert_refused(&output, 2, parts);
        assert!(!bench.path("out").exists());
    }
}
