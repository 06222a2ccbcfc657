//! Text that is too deep, too large or not text, and numbers out of range.

use std::fs;
use std::time::{Duration, Instant};

use super::{list, load, refuse_rows, write_mine};
use crate::sandbox::{Sandbox, assert_done, assert_refused, make_fifo, rows, stderr};

#[test]
fn deep_kernels_load_or_are_refused_with_their_line() {
    let sum = |terms: usize| format!("value.x = here.x{};", " + here.x".repeat(terms - 1));
    let choices = |count: usize| {
        let branch = |at| format!(" else if here.x > {at}.5 {{ value.x = {at}.0; }}");
        let branches: String = (0..count).map(branch).collect();
        format!("if here.x > 1e9 {{ }}{branches}")
    };
    let brackets =
        |count: usize| format!("value.x = {}1.0{};", "(".repeat(count), ")".repeat(count));
    let listed = |statements: &str| list(&write_mine(&[("// statements", statements)]));
    // Each term counts twice: as a sum and as a member.
    for statements in [sum(490), choices(300), brackets(150)] {
        assert_done(&listed(&statements));
    }
    let parts = "mine.wgsl:18: more than 1000 operators | allowed: at most 1000";
    let sums = [2_000, 20_000].map(sum);
    let choices = [2_000, 3_000].map(choices);
    for statements in sums.iter().chain(&choices).chain([&brackets(100_000)]) {
        assert_refused(&listed(statements), 2, &parts);
    }
    // Errors from Naga's own limits name their place too.
    assert_refused(&listed(&brackets(400)), 2, &["mine.wgsl"]);
    // Many declarations that refer to one another, and many statements.
    let mut constants = "const c0 = 1;\n".to_owned();
    for index in 1..10_000 {
        constants.insert_str(0, &format!("const c{index} = c{};\n", index - 1));
    }
    load(&write_mine(&[("// declarations", &constants)])).unwrap();
}

#[cfg(unix)]
#[test]
fn irregular_and_large_files_are_refused() {
    use std::os::unix::fs::symlink;

    let sandbox = write_mine(&[]);
    sandbox.put("secret", "the secret");
    for (file, limit) in [("filter.toml", 1 << 20), ("mine.wgsl", 256 << 10)] {
        let path = sandbox.path("mine").join(file);
        let whole = fs::read(&path).unwrap();
        let mut large = whole.clone();
        large.resize(limit + 1, b'\n');
        let at_most = format!("holds {} bytes, and at most {limit} are read", limit + 1);
        let outside = "is a link to a file outside of the filter's folder";
        let kinds: [(&dyn Fn(), &str); 6] = [
            (&|| fs::write(&path, &large).unwrap(), &at_most),
            (&|| fs::write(&path, b"\xff\xfe").unwrap(), "not UTF-8"),
            (&|| symlink("/dev/zero", &path).unwrap(), "is a device"),
            (&|| symlink("../secret", &path).unwrap(), outside),
            (&|| make_fifo(&path), "is a FIFO"),
            (&|| fs::create_dir(&path).unwrap(), "is a folder"),
        ];
        for (make, found) in kinds {
            fs::remove_file(&path).unwrap();
            make();
            assert_refused(&list(&sandbox), 2, &[file, found]);
        }
        fs::remove_dir(&path).unwrap();
        fs::write(&path, whole).unwrap();
    }
    assert_done(&list(&sandbox));
}

#[test]
fn extreme_numbers_and_texts_are_refused_with_their_line() {
    refuse_rows("text");
}

#[test]
fn thousands_of_presets_and_parameters_are_refused_quickly() {
    let start = Instant::now();
    let preset = "doc = \"d\"\nvalues = { samples = 2 }\n";
    let parameter = "kind = \"integer\"\ndefault = 1\nrange = [0, 2]\ndoc = \"d\"\n";
    for (table, text, found) in [
        ("preset", preset, "8001 [[preset]]"),
        ("parameter", parameter, "8002 [[parameter]]"),
    ] {
        let made = |index| format!("[[{table}]]\nname = \"p{index}\"\n{text}");
        let tables: String = (0..8_000).map(made).collect();
        let sandbox = write_mine(&[("[[pass]]", &format!("{tables}[[pass]]"))]);
        assert_refused(&list(&sandbox), 2, &[found, "at most 256"]);
    }
    assert!(start.elapsed() < Duration::from_secs(60));
}

#[test]
fn values_out_of_range_are_refused_before_a_run() {
    let sandbox = write_mine(&[]);
    for row in rows(include_str!("refusals.toml"), "values") {
        let set = format!("mine.{}", row[0]);
        let output = sandbox.run(&["--filter", "./mine", "--set", &set]);
        assert_refused(&output, 2, &row[1..]);
        assert!(!sandbox.path("out").exists());
    }
}

/// Binds the declarations of the fuzzer corpus's module.
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
    let part = "error: ./module/module.spv: naga, which translates it, fails on it: called";
    assert_refused(&output, 2, &[part]);
    let said = stderr(&output);
    assert!(said.starts_with("error: "), "{said}");
    assert!(!said.contains("panicked"), "{said}");
    assert!(!said.contains("backtrace"), "{said}");
}
