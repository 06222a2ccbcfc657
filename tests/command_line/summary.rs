//! Summary of a run and verdict of a check, as a newcomer sees them.

use std::fs;

use tests::text::assert_contains;

use crate::sandbox::{Sandbox, split, stdout};

#[test]
fn a_run_ranks_filters_in_at_most_40_lines_and_names_the_report() {
    let sandbox = Sandbox::new();
    // All filters of a run that names none.
    let text = sandbox.measure("--jitter-frames 0");
    assert!(text.lines().count() <= 40, "{text}");
    assert_contains(&text, &["centred shutter", "--table shows all"]);
    let page = fs::read_to_string(sandbox.path("out/report.html")).unwrap();
    assert!(page.contains("jump_flood"));
    let again = sandbox.measure("--jitter-frames 0 --table");
    assert!(again.lines().count() > 60, "{again}");
    let cases = sandbox.read_run().cases.len();
    assert_contains(
        &again,
        &[&format!("cases: {cases}, {cases} of them read back")],
    );
}

#[test]
fn filters_within_noise_share_ranks() {
    let filters = "--filters jump_flood:paper,jump_flood_packed:paper,identity";
    let text = Sandbox::new().measure(filters);
    let ranks: Vec<&str> = (text.lines())
        .filter(|line| line.contains(":paper") || line.contains("identity:"))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert_eq!(ranks, ["1-2", "1-2", "3"], "{text}");
}

#[test]
fn an_override_shows_in_the_name_the_folder_and_the_tables() {
    let sandbox = Sandbox::new();
    let words = "--filters velocity_gather:fine --set velocity_gather.samples=2";
    let name = "velocity_gather:fine samples=2";
    assert_contains(&sandbox.measure(words), &[name]);
    assert_contains(&sandbox.measure(&format!("{words} --table")), &[name]);
    let case = &sandbox.read_filter_cases()[0];
    assert_eq!(case.name(), name);
    let folder = "plate/velocity_gather_fine_samples_2";
    assert_eq!(case.folder.to_str(), Some(folder));
    assert!(
        sandbox
            .path("out")
            .join(folder)
            .join("output.exr")
            .is_file()
    );
    let page = fs::read_to_string(sandbox.path("out/report.html")).unwrap();
    assert!(page.contains(name));
}

#[test]
fn a_check_ends_with_its_verdict_and_counts_targets_apart() {
    let sandbox = Sandbox::new();
    let target = "flip_moving = { limit = 0.2, why = \"it serves a test\", level = \"report\" }\n";
    let kept = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";
    let both = format!("[default]\n{target}{kept}");
    let listed = "target missed flip_moving";
    for (bounds, more, code, end) in [
        (both.clone(), "", 0, "\nPASS\n"),
        (both.clone(), "-v", 0, "\nPASS\n"),
        (
            both.replace(", level = \"report\"", ""),
            "",
            1,
            "\nFAIL: a required bound is broken\n",
        ),
    ] {
        fs::write(sandbox.path("scenes/bounds.toml"), bounds).unwrap();
        let output = sandbox.check(&split(&format!("--filters identity {more}")));
        let text = stdout(&output);
        assert_eq!(output.status.code(), Some(code), "{text}");
        assert!(text.ends_with(end), "{text}");
        assert_eq!(text.contains("1 target: 1 missed"), code == 0, "{text}");
        assert_eq!(text.contains(listed), more == "-v", "{text}");
    }
}
