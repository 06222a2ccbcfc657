//! Output of commands, compared with files of `snapshots/`. `SNAPSHOTS=overwrite` writes these
//! anew, for a reviewer to read.

use snapbox::{Assert, Data, Redactions};
use tests::filter_folder::one_kernel;

use crate::sandbox::{Sandbox, split, stderr, stdout};

/// Compares a command's output with a file of `snapshots/`.
#[track_caller]
fn assert_printed(text: &str, file: &str) {
    let mut redactions = Redactions::new();
    let parts = [
        ("[TIME]", "took ", '\n'),
        ("[SIZE]", "report.html (", ')'),
        ("[ADAPTER]", "adapter: ", '\n'),
    ];
    for (name, before, after) in parts {
        let rest = text.split_once(before).map(|(_, rest)| rest);
        if let Some(value) = rest.and_then(|rest| rest.split(after).next()) {
            redactions.insert(name, value.to_owned()).unwrap();
        }
    }
    let folder = tests::root().join("tests/command_line/snapshots");
    let due = Data::read_from(&folder.join(file), None);
    let assert = Assert::new().action_env("SNAPSHOTS");
    assert.redact_with(redactions).eq(text, due);
}

/// Makes a sandbox of two scenes with a limit that the identity breaks, one that it keeps, and a
/// target that it misses.
fn make_bounded() -> Sandbox {
    let sandbox = Sandbox::two_scenes();
    sandbox.write("bounds.toml", include_str!("snapshots/bounds.toml"));
    sandbox.copy_bound("slow");
    sandbox
}

#[test]
fn lists() {
    let sandbox = make_bounded();
    for (words, file) in [
        ("list", "list.txt"),
        ("list inputs", "list_inputs.txt"),
        ("list plate", "list_scene.txt"),
    ] {
        assert_printed(&sandbox.done(words), file);
    }
}

#[test]
fn runs() {
    let sandbox = Sandbox::two_scenes();
    let forms = "--scenes plate --frame-rate 24,48 --input velocity=linear8 --input depth=float16";
    for (more, file) in [
        ("", "run.txt"),
        ("--table", "run_table.txt"),
        (forms, "run_inputs.txt"),
        ("--frames 2 --no-cache", "run_sequence.txt"),
    ] {
        let printed = sandbox.measure(&format!("--filter identity {more}"));
        assert_printed(&printed, file);
    }
}

#[test]
fn checks() {
    let sandbox = make_bounded();
    for (more, file) in [("", "check.txt"), ("-v", "check_verbose.txt")] {
        let output = sandbox.check(&split(&format!("--filter identity {more}")));
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        assert_printed(&stdout(&output), file);
    }
}

/// A kernel that halves colours is exact on every adapter.
#[test]
fn comparisons() {
    let sandbox = Sandbox::two_scenes();
    let body = "textureStore(output, pixel, parameters.gain * textureLoad(color, pixel, 0));";
    let kernel = one_kernel("gain: f32", body);
    sandbox.write_filter("dim", include_str!("snapshots/dim.toml"), &kernel);
    sandbox.measure("--filters identity,./dim");
    sandbox.measure_into("other", "--filters identity,./dim --set dim.gain=0.5");
    assert_printed(&sandbox.done("compare out other"), "compare.txt");
    assert_printed(&sandbox.done("list --filter ./dim"), "list_filter.txt");
}
