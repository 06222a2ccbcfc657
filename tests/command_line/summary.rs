//! Summary of a run, as newcomers see it.

use tests::text::assert_contains;

use crate::sandbox::Sandbox;

#[test]
fn a_run_ranks_filters_in_at_most_40_lines_and_names_the_report() {
    let sandbox = Sandbox::new();
    // A run without named filters uses all.
    let text = sandbox.measure("--jitter-frames 0");
    assert!(text.lines().count() <= 40, "{text}");
    assert_contains(&text, &["centred shutter", "--table shows all"]);
    let page = sandbox.text("out/report.html");
    assert!(page.contains("jump_flood"));
    let again = sandbox.measure("--jitter-frames 0 --table");
    assert!(again.lines().count() > 60, "{again}");
    let cases = sandbox.read_run().cases.len();
    let due = format!("cases: {cases}, {cases} of them read back");
    assert_contains(&again, &[&due]);
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
