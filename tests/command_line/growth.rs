//! The script that makes large runs of copies of a small one.

use std::path::Path;
use std::process::Command;

use crate::python::python_with;
use crate::sandbox::{Sandbox, assert_done, stdout};

#[test]
fn a_run_of_copies_is_merged_judged_and_reported() {
    let sandbox = Sandbox::new();
    sandbox.write(
        "bounds.toml",
        "[filter.\"velocity_gather:fine\"]\nflip_moving = { limit = 0.9, why = \"it serves a test\" }\n",
    );
    std::fs::write(sandbox.path("scenes/bounds.toml"), "").unwrap();
    assert_done(&sandbox.run(&["--filters", "velocity_gather:fine"]));
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/growth.py");
    let grow = |words: &[&str]| {
        let mut command = Command::new(python_with(&["json"]));
        command
            .arg(&script)
            .current_dir(sandbox.path(""))
            .args(words);
        command
            .args(["--program", env!("CARGO_BIN_EXE_shuttertruth")])
            .output()
            .unwrap()
    };
    let words = ["out", "--scenes", "3", "--filters", "4", "--out", "grown"];
    let output = grow(&words);
    assert_done(&output);
    let text = stdout(&output);
    assert!(
        text.starts_with("33 cases in 15 parts, 3 scenes\n"),
        "{text}"
    );
    for step in ["merge: ", "check: ", "report: ", "report.html: "] {
        assert!(text.contains(step), "{text}");
    }
    let run = suite::Run::read(&sandbox.path("grown/merged/run.json")).unwrap();
    let names: Vec<(String, String)> = (run.cases.iter().filter(|case| !case.is_reference))
        .map(|case| (case.scene.to_string(), case.filter.clone()))
        .collect();
    assert_eq!(names.len(), 12);
    assert_eq!(
        names[5],
        ("plate_0001".to_owned(), "velocity_gather_0001".to_owned())
    );
    let judgement = sandbox.path("grown/merged/judgement.json");
    let judgement: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(judgement).unwrap()).unwrap();
    assert_eq!(judgement["findings"].as_array().unwrap().len(), 12);

    let again = grow(&words);
    assert!(!again.status.success());
    assert!(String::from_utf8_lossy(&again.stderr).contains("grown: is there already"));
}
