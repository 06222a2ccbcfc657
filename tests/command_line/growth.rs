//! The script that makes large runs from copies of a small one.

use std::process::Command;

use serde_json::Value;
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_done, python_with, split, stderr, stdout};

#[test]
fn a_run_of_copies_is_merged_judged_and_reported() {
    let sandbox = Sandbox::new();
    let limit = "flip_moving = { limit = 0.9, why = \"it serves a test\" }";
    let bounds = format!("[filter.\"velocity_gather:fine\"]\n{limit}\n");
    sandbox.write("bounds.toml", &bounds);
    sandbox.put("scenes/bounds.toml", "");
    assert_done(&sandbox.run(&["--filters", "velocity_gather:fine"]));
    let grow = || {
        let mut command = Command::new(python_with(&["json"]));
        command.arg(tests::root().join("examples/growth.py"));
        command.args(split("out --scenes 3 --filters 4 --out grown --program"));
        command.arg(env!("CARGO_BIN_EXE_shuttertruth"));
        command.current_dir(sandbox.path("")).output().unwrap()
    };
    let output = grow();
    assert_done(&output);
    let text = stdout(&output);
    let begin = "33 cases in 15 parts, 3 scenes\n";
    assert!(text.starts_with(begin), "{text}");
    assert_contains(&text, &["merge: ", "check: ", "report: ", "report.html: "]);
    let run = measure::Run::read(&sandbox.path("grown/merged/run.json")).unwrap();
    let cases = run.cases.iter().filter(|case| !case.is_reference);
    let names: Vec<String> = cases
        .map(|case| format!("{} {}", case.scene, case.filter))
        .collect();
    assert_eq!(names.len(), 12);
    assert_eq!(names[5], "plate_0001 velocity_gather_0001");
    let judgement: Value = sandbox.read_json("grown/merged/judgement.json");
    assert_eq!(judgement["findings"].as_array().unwrap().len(), 12);

    let again = grow();
    assert!(!again.status.success());
    assert_contains(&stderr(&again), &["grown: is there already"]);
}
