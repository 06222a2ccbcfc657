//! Parts of truths, joined: the same bytes as one process's, or a refusal.

use std::fs;
use std::path::Path;
use std::process::Child;

use crate::kept::{assert_whole, remove_support, render, render_part, rendered, spawn};
use crate::kept_cases::damage;
use crate::sandbox::{Sandbox, assert_refused, split};

const REPLICATE: &str = "plate/truth_trailing/replicate_002.exr";

/// Renders parts at the same time, one process each.
fn render_at_once(sandbox: &Sandbox, parts: &[(&str, &str)]) {
    let start = |(out, part): &(&str, &str)| spawn(sandbox, &render(out, &["--replicates", part]));
    let children: Vec<Child> = parts.iter().map(start).collect();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
}

#[test]
fn parts_of_several_processes_equal_the_bytes_of_one() {
    let sandbox = Sandbox::new();
    render_at_once(&sandbox, &[("a", "0..3"), ("b", "3..4"), ("c", "4..8")]);
    let merged = sandbox.done("truths merge c a b --out joined");
    assert_eq!(merged, "joined/plate/truth_trailing.exr (8 replicates)\n");
    assert_whole(&sandbox, "joined");
    let parts = ["0..3", "2..5", "5..8", "0..8"];
    render_at_once(&sandbox, &parts.map(|part| ("shared", part)));
    sandbox.done("truths merge shared --out shared");
    assert_whole(&sandbox, "shared");
}

fn replace_by_another(path: &Path) {
    fs::copy(path.with_file_name("replicate_000.exr"), path).unwrap();
}

#[test]
fn damaged_replicates_are_rendered_again_and_never_merged() {
    type Damage = fn(&Path);
    let old = [
        "holds no support",
        "make it anew with `shuttertruth truths render`",
    ];
    let rows: [(Damage, &[&str]); 4] = [
        (|path| damage(path, "altered"), &[REPLICATE]),
        (|path| damage(path, "cut"), &[REPLICATE]),
        (replace_by_another, &[REPLICATE]),
        (remove_support, &old),
    ];
    for (damage, complaint) in rows {
        let sandbox = rendered();
        fs::remove_file(sandbox.path("out/plate/truth_trailing.exr")).unwrap();
        damage(&sandbox.path("out").join(REPLICATE));
        let merged = sandbox.shuttertruth(&split("truths merge out --out joined"));
        assert_refused(&merged, 2, &[REPLICATE]);
        assert_refused(&merged, 2, complaint);
        assert!(!sandbox.path("joined").exists());
        sandbox.execute(&render("out", &[]));
        assert_whole(&sandbox, "out");
    }
}

/// Folders to merge, and parts of the message.
const INCOMPLETE: [(&str, &[&str]); 6] = [
    (
        "start gap",
        &["3, 4", "replicates 3..4", "plate/truth_trailing"],
    ),
    ("start", &["replicates 3 are missing", "truth of 4"]),
    (
        "start other",
        &["start/plate/frame.exr", "other/plate/frame.exr", "differ"],
    ),
    (
        "start rest",
        &["replicate 3", "other inputs", "content hash"],
    ),
    (
        "start empty",
        &[
            "empty",
            "holds no replicates",
            "a part A..B of the replicates",
        ],
    ),
    ("nowhere", &["nowhere", "cannot read"]),
];

#[test]
fn incomplete_parts_are_refused() {
    let sandbox = Sandbox::new();
    render_part(&sandbox, "start", "0..3");
    render_part(&sandbox, "gap", "5..8");
    // Replicates of other truths: some files share a name with the first ones, or none does.
    for (out, part) in [("other", "0..4"), ("rest", "3..4")] {
        sandbox.execute(&render(out, &["--replicates", part, "--seed", "2"]));
    }
    fs::create_dir(sandbox.path("empty")).unwrap();
    sandbox.refuse_each("truths merge --out joined", &INCOMPLETE);
    assert!(!sandbox.path("joined").exists(), "nothing is written");
}
