//! Summary of a run and verdict of a check, as a newcomer sees them.

use std::fs;

use crate::sandbox::{Sandbox, assert_done, stdout};

#[test]
fn a_run_ranks_filters_in_at_most_40_lines_and_names_the_report() {
    let sandbox = Sandbox::two_scenes();
    let output = sandbox.run(&["--jitter-frames", "0"]);
    assert_done(&output);
    let text = stdout(&output);
    assert!(text.lines().count() <= 40, "{text}");
    assert!(text.contains("centred shutter"), "{text}");
    assert!(text.contains("--table shows all"), "{text}");
    let page = fs::read_to_string(sandbox.path("out/report.html")).unwrap();
    assert!(page.contains("jump_flood"));
    let again = stdout(&sandbox.run(&["--jitter-frames", "0", "--table"]));
    assert!(again.lines().count() > 60, "{again}");
    let cases = sandbox.read_run().cases.len();
    assert!(
        again.contains(&format!("cases: {cases}, {cases} of them read back")),
        "{again}"
    );
}

#[test]
fn filters_within_noise_share_ranks() {
    let sandbox = Sandbox::new();
    let text = stdout(&sandbox.run(&[
        "--filters",
        "jump_flood:paper,jump_flood_packed:paper,identity",
    ]));
    let ranks: Vec<&str> = (text.lines())
        .filter(|line| line.contains(":paper") || line.contains("identity:"))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert_eq!(ranks, ["1-2", "1-2", "3"], "{text}");
}

#[test]
fn an_override_shows_in_the_name_the_folder_and_the_tables() {
    let sandbox = Sandbox::new();
    let words = [
        "--filters",
        "velocity_gather:fine",
        "--set",
        "velocity_gather.samples=2",
    ];
    let output = sandbox.run(&words);
    assert_done(&output);
    let name = "velocity_gather:fine samples=2";
    assert!(stdout(&output).contains(name), "{}", stdout(&output));
    let table = stdout(&sandbox.run(&[&words[..], &["--table"]].concat()));
    assert!(table.contains(name), "{table}");
    let case = &sandbox.read_filter_cases()[0];
    assert_eq!(case.name(), name);
    assert_eq!(
        case.folder.to_str(),
        Some("plate/velocity_gather_fine_samples_2")
    );
    assert!(
        sandbox
            .path("out/plate/velocity_gather_fine_samples_2/output.exr")
            .is_file()
    );
    assert!(
        fs::read_to_string(sandbox.path("out/report.html"))
            .unwrap()
            .contains(name)
    );
}

#[test]
fn a_check_ends_with_its_verdict_and_counts_targets_apart() {
    let sandbox = Sandbox::new();
    let verdict = |bounds: &str, more: &[&str]| {
        fs::write(sandbox.path("scenes/bounds.toml"), bounds).unwrap();
        let output = sandbox.check(&[&["--filters", "identity"], more].concat());
        (output.status.code(), stdout(&output))
    };
    let target = "flip_moving = { limit = 0.2, why = \"it serves a test\", level = \"report\" }\n";
    let kept = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";
    let both = format!("[default]\n{target}{kept}");
    let (code, text) = verdict(&both, &[]);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.ends_with("\nPASS\n"), "{text}");
    assert!(text.contains("1 target: 1 missed"), "{text}");
    assert!(!text.contains("target missed flip_moving"), "{text}");
    let (_, text) = verdict(&both, &["-v"]);
    assert!(text.contains("target missed flip_moving"), "{text}");
    let (code, text) = verdict(
        &format!("[default]\n{}", target.replace(", level = \"report\"", "")),
        &[],
    );
    assert_eq!(code, Some(1), "{text}");
    assert!(
        text.ends_with("\nFAIL: a required bound is broken\n"),
        "{text}"
    );
}
