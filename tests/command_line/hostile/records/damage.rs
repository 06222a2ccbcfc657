//! Changed numbers and lists of a run.json. Each must give a report, or an error that names the file.

use std::collections::BTreeMap;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use cli::{compare_table, run_table};
use judge::{Acceptance, Baseline, accept_scores, compare_runs};
use report::{LARGEST_PAGE, compare_page, write_report};
use serde_json::{Value, json};
use suite::{Error, Run, StoredRun};

use crate::sandbox::{Sandbox, assert_done, assert_refused};

/// Collects the JSON pointers of all values. Of cases and objects it takes only the first: the others are alike.
fn pointers(value: &Value, at: &str, all: &mut Vec<String>) {
    all.push(at.to_owned());
    match value {
        Value::Object(fields) => {
            for (name, value) in fields {
                pointers(value, &format!("{at}/{name}"), all);
            }
        }
        Value::Array(values) => {
            if let Some(first) = values.first() {
                pointers(first, &format!("{at}/0"), all);
            }
        }
        _ => {}
    }
}

/// Returns hostile replacements for a value.
fn hostile(value: &Value) -> Vec<Value> {
    match value {
        Value::Number(_) => vec![json!(-1), json!(4294967295u32), json!(1e308), Value::Null],
        Value::Array(_) => vec![json!([]), json!({}), json!([[[[1]]]])],
        Value::Bool(own) => vec![json!(!own), json!(2)],
        Value::String(_) => vec![json!("a\n::error::b"), json!("../../x"), json!("")],
        Value::Object(_) => vec![json!({}), json!([1, 2])],
        Value::Null => vec![json!(3)],
    }
}

/// Reads a run.json in memory, as every command does.
fn read_everywhere(changed: &Path, whole: &StoredRun) -> Result<(), Error> {
    let side = StoredRun::read(changed)?;
    let folder = changed.parent().unwrap();
    let _ = run_table(&side.run);
    let go_on = |_| std::ops::ControlFlow::Continue(());
    if let Ok(compared) = compare_runs(whole, &side, &BTreeMap::new(), &go_on) {
        let _ = compare_table(&compared);
        let _ = compare_page(&compared, whole, &side);
    }
    let how = Acceptance {
        only: None,
        reason: "it serves a test",
        forced: true,
    };
    let _: Result<Baseline, Error> = accept_scores(&side.run, None, &how);
    let page = folder.join("page.html");
    write_report(&side.run, &[], folder, &page, LARGEST_PAGE).map(drop)
}

#[test]
fn a_changed_value_of_run_json_never_ends_the_program() {
    let sandbox = Sandbox::new();
    fs::write(
        sandbox.path("scenes/bounds.toml"),
        "[default]\nflip_moving = { limit = 0.01, why = \"it serves a test\" }\n",
    )
    .unwrap();
    // Broken and too strict bounds have evidence.
    let check = sandbox.check(&["--filters", "jump_flood:paper"]);
    assert!(matches!(check.status.code(), Some(1 | 2)));
    let path = sandbox.path("out/run.json");
    let text = fs::read_to_string(&path).unwrap();
    let mut whole: Value = serde_json::from_str(&text).unwrap();
    // One reference is enough; the filter's case is the last.
    let cases = whole["cases"].as_array_mut().unwrap();
    let last = cases.pop().unwrap();
    cases.truncate(1);
    cases.insert(0, last);
    fs::write(&path, whole.to_string()).unwrap();
    let side = StoredRun::read(&path).unwrap();
    let changed = sandbox.path("out/changed.json");
    read_everywhere(&path, &side).unwrap();

    let mut all = Vec::new();
    pointers(&whole, "", &mut all);
    assert!(all.len() > 300, "only {} values", all.len());
    let mut ended = Vec::new();
    let mut refused = 0;
    for (index, pointer) in all.iter().enumerate() {
        let due = hostile(whole.pointer(pointer).unwrap());
        // Each value gets a different hostile one. Scores are many and alike.
        let is_score = pointer.contains("scores/") || pointer.contains("common/");
        let due: Vec<Value> = match is_score {
            true => vec![due[index % due.len()].clone()],
            false => due,
        };
        for value in due {
            let mut copy = whole.clone();
            *copy.pointer_mut(pointer).unwrap() = value.clone();
            fs::write(&changed, copy.to_string()).unwrap();
            match catch_unwind(AssertUnwindSafe(|| read_everywhere(&changed, &side))) {
                Ok(Ok(())) => {}
                Ok(Err(_)) => refused += 1,
                Err(_) => ended.push(format!("{pointer} = {value}")),
            }
        }
    }
    assert!(ended.is_empty(), "these panic:\n{}", ended.join("\n"));
    assert!(refused > 200, "only {refused} were refused");
}

#[test]
fn a_file_that_is_not_a_run_json_is_refused_with_its_name() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity"]));
    let path = sandbox.path("out/run.json");
    let text = fs::read_to_string(&path).unwrap();
    let whole: Value = serde_json::from_str(&text).unwrap();
    let mut many = whole.clone();
    let one = whole["cases"][0].clone();
    many["cases"] = json!(vec![one; 400]);
    let with = |name: &str, value: Value| {
        let mut changed = whole.clone();
        *changed.pointer_mut(name).unwrap() = value;
        changed.to_string()
    };
    for (text, found) in [
        (String::new(), "no run of this program"),
        ("[".repeat(100_000), "no run of this program"),
        (
            format!("{{\"x\": {}", "[".repeat(100_000)),
            "recursion limit",
        ),
        (
            format!("{{\"format\": {}", "1".repeat(1 << 20)),
            "no run of this program",
        ),
        (many.to_string(), "belongs to two cases"),
        (
            with("/width", json!(1)),
            "pictures of 1x32 pixels; allowed: 16 to 16384",
        ),
        (
            with("/replicates", json!(4_000_000_000u32)),
            "4000000000 replicates; allowed: 1 to 4096",
        ),
        (
            with("/cases/0/alignment", json!("sideways")),
            "unknown variant `sideways`, expected one of `trailing`, `centred`, `leading`",
        ),
        (
            with("/cases/0/exposure", json!(-1)),
            "exposure is -1 frames",
        ),
        (with("/cases/0/folder", json!("../x")), "and nowhere else"),
        (
            with("/cases/0/folder", json!("plate/a\u{1b}[2J")),
            "folder \"plate/a\\u001b[2J\"",
        ),
    ] {
        fs::write(&path, text).unwrap();
        for words in [
            &["report", "out", "--html", "page.html"][..],
            &["compare", "out", "out"],
            &[
                "limits", "accept", "--out", "out", "--reason", "a test", "--force",
            ],
        ] {
            let output = sandbox.command(words).env_remove("CI").output().unwrap();
            assert_refused(&output, 2, &["out/run.json", found]);
        }
        assert!(!sandbox.path("base.json").exists());
    }
    fs::write(&path, [b'"', 0xff, b'"']).unwrap();
    assert!(
        Run::read(&path)
            .unwrap_err()
            .to_string()
            .contains("not UTF-8")
    );
    #[cfg(unix)]
    {
        fs::remove_file(&path).unwrap();
        std::os::unix::fs::symlink("/dev/zero", &path).unwrap();
        assert!(
            Run::read(&path)
                .unwrap_err()
                .to_string()
                .contains("is a device")
        );
    }
}

#[test]
fn a_file_that_is_not_a_baseline_or_bench_is_refused_with_its_name() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity"]));
    for (text, found) in [
        ("[1]", "no baseline"),
        (
            "{\"format\": 99, \"program\": \"\", \"adapter\": null, \"reasons\": [], \"truths\": {}, \"scores\": {}}",
            "has format 99",
        ),
        (
            "{\"format\": 1, \"truths\": {\"plate\": {\"a\\u001b[2J\": \"\"}}}",
            "unknown variant `a\\u001b[2J`",
        ),
    ] {
        fs::write(sandbox.path("base.json"), text).unwrap();
        let output = sandbox.check(&["--filters", "identity", "--baseline", "base.json"]);
        assert_refused(&output, 2, &["base.json", found]);
    }
    for text in ["[1]", "{\"format\": 1}", "null"] {
        fs::write(sandbox.path("out/bench.json"), text).unwrap();
        let report = sandbox.shuttertruth(&["report", "out", "--html", "page.html"]);
        assert_refused(&report, 2, &["bench.json", "no bench of this program"]);
    }
}
