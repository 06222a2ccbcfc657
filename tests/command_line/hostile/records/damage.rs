//! Changed numbers and lists of a run.json. Each must lead to a report, or to an error that names the file.

use std::collections::BTreeMap;
use std::fs;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use cli::{compare_table, run_table};
use judge::{Acceptance, Baseline, accept_scores, compare_runs};
use report::{LARGEST_PAGE, compare_page, write_report};
use serde_json::{Value, json};
use suite::{Error, Run, StoredRun};
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_refused, rows, split};

/// Collects the JSON pointers of all values, but only of the first case and object: the others are alike.
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
    let go_on = |_| ControlFlow::Continue(());
    if let Ok(compared) = compare_runs(whole, &side, &BTreeMap::new(), &go_on) {
        let _ = compare_table(&compared);
        let _ = compare_page(&compared, whole, &side);
    }
    let (only, reason, forced) = (None, "it serves a test", true);
    let how = Acceptance {
        only,
        reason,
        forced,
    };
    let _: Result<Baseline, Error> = accept_scores(&side.run, None, &how);
    let page = folder.join("page.html");
    write_report(&side.run, &[], None, folder, &page, LARGEST_PAGE).map(drop)
}

/// Changes every value of a run.json `most` times; scores, which are many and alike, once.
fn change_values(most: usize) {
    let sandbox = Sandbox::new();
    // Broken and too strict bounds have evidence.
    sandbox.write_bound(0.01);
    let check =
        "check --quiet --out out --size 16x16 --samples-per-pixel 64 --filter jump_flood:paper";
    let check = sandbox.outside_ci(&split(check));
    assert!(matches!(check.status.code(), Some(1 | 2)));
    let path = sandbox.path("out/run.json");
    let mut whole: Value = sandbox.read_json("out/run.json");
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
    let (mut ended, mut refused, mut tried) = (Vec::new(), 0, 0);
    for (index, pointer) in all.iter().enumerate() {
        let mut due = hostile(whole.pointer(pointer).unwrap());
        // Each value gets different ones.
        let count = due.len();
        due.rotate_left(index % count);
        let is_score = pointer.contains("scores/") || pointer.contains("common/");
        due.truncate(if is_score { 1 } else { most });
        for value in due {
            let mut copy = whole.clone();
            *copy.pointer_mut(pointer).unwrap() = value.clone();
            fs::write(&changed, copy.to_string()).unwrap();
            tried += 1;
            match catch_unwind(AssertUnwindSafe(|| read_everywhere(&changed, &side))) {
                Ok(Ok(())) => {}
                Ok(Err(_)) => refused += 1,
                Err(_) => ended.push(format!("{pointer} = {value}")),
            }
        }
    }
    assert!(ended.is_empty(), "these panic:\n{}", ended.join("\n"));
    assert!(4 * refused > tried, "only {refused} of {tried}");
}

#[test]
fn a_changed_value_of_run_json_never_ends_the_program() {
    change_values(1);
}

#[test]
#[ignore = "prove: every hostile number, list and text for every value of run.json"]
fn no_hostile_value_of_run_json_ends_the_program() {
    change_values(usize::MAX);
}

#[test]
fn a_file_that_is_not_a_run_json_is_refused_with_its_name() {
    let sandbox = Sandbox::measured();
    let path = sandbox.path("out/run.json");
    let whole: Value = sandbox.read_json("out/run.json");
    let with = |pointer: &str, value: Value| {
        let mut changed = whole.clone();
        *changed.pointer_mut(pointer).unwrap() = value;
        changed.to_string()
    };
    let many = json!(vec![whole["cases"][0].clone(); 400]);
    let deep = format!("{{\"x\": {}", "[".repeat(100_000));
    let long = format!("{{\"format\": {}", "1".repeat(1 << 20));
    let mut texts = vec![
        (with("/cases", many), "belongs to two cases"),
        (String::new(), "no run of this program"),
        ("[".repeat(100_000), "no run of this program"),
        (deep, "recursion limit"),
        (long, "no run of this program"),
    ];
    for row in rows(include_str!("refusals.toml"), "run") {
        texts.push((with(row[0], serde_json::from_str(row[1]).unwrap()), row[2]));
    }
    for (text, found) in texts {
        fs::write(&path, text).unwrap();
        for line in [
            "report out --html page.html",
            "compare out out",
            "limits accept --out out --reason test --force",
        ] {
            let output = sandbox.outside_ci(&split(line));
            assert_refused(&output, 2, &["out/run.json", found]);
        }
        assert!(!sandbox.path("base.json").exists());
    }
    let refused = |part: &str| assert_contains(&Run::read(&path).unwrap_err().to_string(), &[part]);
    fs::write(&path, [b'"', 0xff, b'"']).unwrap();
    refused("not UTF-8");
    #[cfg(unix)]
    {
        fs::remove_file(&path).unwrap();
        std::os::unix::fs::symlink("/dev/zero", &path).unwrap();
        refused("is a device");
    }
}

#[test]
fn a_file_that_is_not_a_baseline_or_bench_is_refused_with_its_name() {
    let sandbox = Sandbox::measured();
    for row in rows(include_str!("refusals.toml"), "baseline") {
        sandbox.put("base.json", row[0]);
        let output = sandbox.check(&["--filters", "identity", "--baseline", "base.json"]);
        assert_refused(&output, 2, &["base.json", row[1]]);
    }
    for text in ["[1]", "{\"format\": 1}", "null"] {
        sandbox.put("out/bench.json", text);
        let parts = ["bench.json", "no bench of this program"];
        sandbox.refuse("report out --html page.html", &parts);
    }
}
