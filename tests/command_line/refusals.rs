//! Refused command lines: their messages, their exit codes, and no files left behind.

use std::fs;

use serde::Deserialize;
use tests::filter_folder::write_manifest;

use crate::child::{assert_ends_at_ctrl_c, wait_until_busy};
use crate::sandbox::*;

#[test]
fn a_missing_adapter_gives_exit_code_3_and_the_way_out() {
    let sandbox = Sandbox::new();
    sandbox.write_bound(0.9);
    for command in ["run", "check --filters identity", "bench"] {
        let output = sandbox.without_adapter(&split(&format!("{command} --out out")));
        assert_refused(&output, 3, &["mesa-vulkan-drivers"]);
        assert!(!sandbox.path("out").exists(), "{command}");
    }
}

/// Rows of refusals.toml.
#[derive(Deserialize)]
struct Refusals {
    writing: Vec<Refusal>,
    others: Vec<Refusal>,
}

/// Words of a command line, and parts of the message.
#[derive(Deserialize)]
struct Refusal {
    words: String,
    message: Vec<String>,
}

#[test]
fn bad_arguments_are_refused_with_the_allowed_values_and_leave_nothing_behind() {
    let sandbox = Sandbox::two_scenes();
    sandbox.put("file", "no folder");
    let program = "command = ['cp', '{frame}', '{out}']";
    write_manifest(&sandbox.path("outside"), "outside", program);
    let before = files_below(&sandbox.path(""));
    let refusals: Refusals = toml::from_str(include_str!("refusals.toml")).unwrap();
    let writing = refusals
        .writing
        .iter()
        .map(|row| (row, " --quiet --out out"));
    let others = refusals.others.iter().map(|row| (row, ""));
    for (Refusal { words, message }, more) in writing.chain(others) {
        sandbox.refuse(&format!("{words}{more}"), message);
        assert_eq!(files_below(&sandbox.path("")), before, "{words}");
        assert!(!sandbox.path("out").exists(), "{words}");
    }
}

/// All mistakes in scenes are tried on the reader itself.
#[test]
fn a_bad_scene_is_refused_with_file_and_line_and_leaves_nothing_behind() {
    let long = SCENE.replace("exposure = 0.5", "exposure = -0.5");
    let no_face = OBJ.replacen("f 1 3 4", "f 1 3 9", 1);
    for (name, text, parts) in [
        ("scene.toml", long, ["scene.toml:3:", "-0.5", "above 0"]),
        ("plate.obj", no_face, ["plate.obj:8:", "9", "4"]),
    ] {
        let sandbox = Sandbox::new();
        sandbox.write(name, &text);
        for command in ["run --filter identity", "truths render"] {
            sandbox.refuse(&format!("{command} --quiet --out out"), &parts);
            assert!(!sandbox.path("out").exists(), "{command}");
        }
    }
}

#[test]
fn bad_bounds_are_refused_with_file_and_line_and_leave_nothing_behind() {
    let sandbox = Sandbox::checked();
    sandbox.write_bound(0.0001);
    assert_eq!(
        sandbox.check(&["--filters", "identity"]).status.code(),
        Some(1)
    );
    assert_eq!(sandbox.read_findings().len(), 1);
    fs::remove_dir_all(sandbox.path("out")).unwrap();
    let rows: [(&str, &[&str]); 2] = [
        (
            "flip = { limit = 0.1, why = \"it serves a test\" }",
            &["metric \"flip\" is unknown", "flip_moving"],
        ),
        (
            "flip_moving = { limit = 0.2, why = \"one\\n::error::two\" }",
            &["flip_moving: why = \"one\\n::error::two\"", "one line"],
        ),
    ];
    for (bound, parts) in rows {
        sandbox.write("bounds.toml", &format!("[default]\n{bound}\n"));
        let output = sandbox.run(&["--filters", "identity"]);
        assert_refused(&output, 2, &[&["bounds.toml:2"], parts].concat());
        assert!(!sandbox.path("out").exists());
    }
}

#[test]
fn ctrl_c_leaves_no_partial_file() {
    let sandbox = Sandbox::new();
    // Far more samples than the program can render before the interrupt.
    let words = "truths render --quiet --out out --size 1024x512 --samples-per-pixel 65536";
    let mut child = sandbox.command(&split(words)).spawn().unwrap();
    wait_until_busy(&mut child, 50);
    assert_ends_at_ctrl_c(child);
    // Empty; the next process locks it.
    let lock = sandbox.path("out/.shuttertruth.lock");
    assert_eq!(files_below(&sandbox.path("out")), [lock]);
}

#[test]
fn names_that_no_folder_can_have_are_refused_before_anything_is_rendered() {
    let sandbox = Sandbox::new();
    let long = "n".repeat(250);
    let body = "textureStore(output, pixel, textureLoad(color, pixel, 0));";
    sandbox.write_kernel(&long, "", &[], body);
    sandbox.copy_scene(&long, |text| text.replace("-1.6", "-0.8"));
    sandbox.write_bound(1.0);
    sandbox.copy_bound(&long);
    for line in [
        format!("run --filter ./{long} --scenes plate"),
        format!("run --filter identity --scenes {long}"),
        format!("check --filter identity --scenes {long}"),
        format!("truths render --scenes {long}"),
    ] {
        let parts = [
            "folder \"nnnnnn",
            "allowed: up to 240",
            "give them shorter ones",
        ];
        assert_refused(&sandbox.outside_ci(&split(&line)), 2, &parts);
        assert!(!sandbox.path("out").exists(), "{line}");
    }
}
