//! Output of commands, compared with files of `snapshots/`. `SNAPSHOTS=overwrite` writes these anew, for a reviewer to read.

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
        if let Some(found) = rest.and_then(|rest| rest.split(after).next()) {
            redactions.insert(name, found.to_owned()).unwrap();
        }
    }
    let folder = tests::root().join("tests/command_line/snapshots");
    Assert::new()
        .action_env("SNAPSHOTS")
        .redact_with(redactions)
        .eq(text, Data::read_from(&folder.join(file), None));
}

/// Makes a sandbox of two scenes with a limit that the identity breaks, one that it keeps, and a target that it misses.
fn make_bounded() -> Sandbox {
    let sandbox = Sandbox::two_scenes();
    sandbox.write(
        "bounds.toml",
        "[default]
flip_moving = { limit = 0.2, why = \"a smear of half the plate's motion is lost\" }
label_tv = { limit = 0.9, why = \"silhouettes stay where they are\" }
misplacement = { limit = 0.5, why = \"what the paper promises\", level = \"report\" }
occluder_contamination = { limit = 0.5, why = \"nothing passes in front of the plate\" }
",
    );
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
    let forms = "--frame-rate 24,48 --input velocity=linear8 --input depth=float16";
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
    sandbox.write_filter(
        "dim",
        "name = \"dim\"
summary = \"Scales colours.\"
alignment = \"trailing\"
[[parameter]]
name = \"gain\"
kind = \"real\"
default = 1.0
range = [0.0, 1.0]
doc = \"Factor of all colours.\"
[[pass]]
entry = \"work\"
",
        &one_kernel(
            "gain: f32",
            "textureStore(output, pixel, parameters.gain * textureLoad(color, pixel, 0));",
        ),
    );
    sandbox.measure("--filters identity,./dim");
    sandbox.measure_into("other", "--filters identity,./dim --set dim.gain=0.5");
    assert_printed(&sandbox.done("compare out other"), "compare.txt");
    assert_printed(&sandbox.done("list --filter ./dim"), "list_filter.txt");
}
