//! Text that is too deep, too large or not text, and numbers out of range.

use std::fs;
use std::time::{Duration, Instant};

use super::{list, load, write_mine};
use crate::sandbox::{Sandbox, assert_done, assert_refused, make_fifo, stderr};

#[test]
fn deep_kernels_load_or_are_refused_with_their_line() {
    let sum = |terms: usize| format!("value.x = here.x{};", " + here.x".repeat(terms - 1));
    let choices = |count: usize| {
        let branches: String = (0..count)
            .map(|index| format!(" else if here.x > {index}.5 {{ value.x = {index}.0; }}"))
            .collect();
        format!("if here.x > 1e9 {{ }}{branches}")
    };
    let brackets =
        |count: usize| format!("value.x = {}1.0{};", "(".repeat(count), ")".repeat(count));
    // Each term counts twice: as a sum and as a member.
    for statements in [sum(490), choices(300), brackets(150)] {
        let sandbox = write_mine(&[("// statements", &statements)]);
        assert_done(&list(&sandbox));
    }
    for statements in [
        sum(2_000),
        sum(10_000),
        sum(20_000),
        choices(2_000),
        choices(3_000),
        brackets(100_000),
    ] {
        let sandbox = write_mine(&[("// statements", &statements)]);
        let parts = [
            "mine.wgsl:18: more than 1000 operators",
            "allowed: at most 1000",
        ];
        assert_refused(&list(&sandbox), 2, &parts);
    }
    // Errors from Naga's own limits name their place too.
    let sandbox = write_mine(&[("// statements", &brackets(400))]);
    assert_refused(&list(&sandbox), 2, &["mine.wgsl"]);
    // Many declarations that refer to one another, and many statements.
    let mut constants = "const c0 = 1;\n".to_owned();
    for index in 1..10_000 {
        constants.insert_str(0, &format!("const c{index} = c{};\n", index - 1));
    }
    load(&write_mine(&[("// declarations", &constants)])).unwrap();
}

#[test]
fn irregular_and_large_files_are_refused() {
    let sandbox = write_mine(&[]);
    for (file, limit) in [("filter.toml", 1 << 20), ("mine.wgsl", 256 << 10)] {
        let path = sandbox.path("mine").join(file);
        let whole = fs::read(&path).unwrap();
        let mut large = whole.clone();
        large.resize(limit + 1, b'\n');
        fs::write(&path, &large).unwrap();
        let parts = [file, "holds", &format!("at most {limit} are read")];
        assert_refused(&list(&sandbox), 2, &parts);
        fs::write(&path, b"\xff\xfe").unwrap();
        assert_refused(&list(&sandbox), 2, &[file, "not UTF-8"]);
        fs::remove_file(&path).unwrap();
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("/dev/zero", &path).unwrap();
            assert_refused(&list(&sandbox), 2, &[file, "is a device"]);
            fs::remove_file(&path).unwrap();
            fs::write(sandbox.path("secret"), "the secret").unwrap();
            std::os::unix::fs::symlink("../secret", &path).unwrap();
            let parts = [file, "is a link to a file outside of the filter's folder"];
            assert_refused(&list(&sandbox), 2, &parts);
            fs::remove_file(&path).unwrap();
            make_fifo(&path);
            assert_refused(&list(&sandbox), 2, &[file, "is a FIFO"]);
            fs::remove_file(&path).unwrap();
        }
        fs::create_dir(&path).unwrap();
        assert_refused(&list(&sandbox), 2, &[file, "is a folder"]);
        fs::remove_dir(&path).unwrap();
        fs::write(&path, whole).unwrap();
    }
    assert_done(&list(&sandbox));
}

#[test]
fn extreme_numbers_and_texts_are_refused_with_their_line() {
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
        let output = list(&write_mine(&[(from, to)]));
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
fn thousands_of_presets_and_parameters_are_refused_quickly() {
    let start = Instant::now();
    let presets: String = (0..8_000)
        .map(|index| {
            format!("[[preset]]\nname = \"p{index}\"\ndoc = \"d\"\nvalues = {{ samples = 2 }}\n")
        })
        .collect();
    let sandbox = write_mine(&[("[[pass]]", &format!("{presets}[[pass]]"))]);
    assert_refused(&list(&sandbox), 2, &["8001 [[preset]]", "at most 256"]);
    let parameters: String = (0..8_000)
        .map(|index| format!("[[parameter]]\nname = \"p{index}\"\nkind = \"integer\"\ndefault = 1\nrange = [0, 2]\ndoc = \"d\"\n"))
        .collect();
    let sandbox = write_mine(&[("[[pass]]", &format!("{parameters}[[pass]]"))]);
    assert_refused(&list(&sandbox), 2, &["8002 [[parameter]]", "at most 256"]);
    assert!(start.elapsed() < Duration::from_secs(60));
}

#[test]
fn values_out_of_range_are_refused_before_a_run() {
    let sandbox = write_mine(&[]);
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
        let output = sandbox.run(&["--filter", "./mine", "--set", &set]);
        assert_refused(&output, 2, parts);
        assert!(!sandbox.path("out").exists());
    }
}

/// Binds what the module of the fuzzer's corpus declares.
const MODULE: &str = "name = \"module\"\nsummary = \"A damaged module.\"\nalignment = \"centred\"\n\n[[pass]]\nshader = \"module.spv\"\n";

#[test]
fn a_panic_of_naga_is_one_error_and_no_backtrace() {
    let sandbox = Sandbox::new();
    let folder = sandbox.path("module");
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("filter.toml"), MODULE).unwrap();
    let damaged = tests::root().join("tests/fuzz/corpus/spirv/panic");
    fs::copy(damaged, folder.join("module.spv")).unwrap();
    let mut command = sandbox.command(&["list", "--filter", "module"]);
    let output = command.env("RUST_BACKTRACE", "1").output().unwrap();
    let parts = ["error: ./module/module.spv: naga, which translates it, fails on it: called"];
    assert_refused(&output, 2, &parts);
    let said = stderr(&output);
    assert!(said.starts_with("error: "), "{said}");
    assert!(
        !said.contains("panicked") && !said.contains("backtrace"),
        "{said}"
    );
}
