//! Tables as CSV and Markdown. Those of `bench` are tested beside its times.

use std::collections::BTreeMap;

use measure::Run;
use metrics::Metric;

use crate::sandbox::Sandbox;

/// Reads CSV without quoted cells into rows by title.
pub fn read_csv(text: &str) -> Vec<BTreeMap<&str, &str>> {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let titles = lines.next().unwrap();
    let row = |cells: Vec<_>| {
        assert_eq!(cells.len(), titles.len(), "{cells:?}");
        titles.iter().copied().zip(cells).collect()
    };
    lines.map(row).collect()
}

#[test]
fn the_csv_of_a_run_has_every_score_of_every_case() {
    let sandbox = Sandbox::measured();
    sandbox.measure("--filters identity --csv scores.csv");
    let run: Run = sandbox.read_run();
    let text = sandbox.text("scores.csv");
    let rows = read_csv(&text);
    assert_eq!(rows.len(), run.cases.len());
    for (row, case) in rows.iter().zip(&run.cases) {
        let (scene, filter) = (case.scene.to_string(), case.name());
        assert_eq!(row["scene"], scene);
        assert_eq!(row["filter"], filter);
        assert_eq!(row["shutter"], case.alignment.name());
        assert_eq!(row["is_reference"], case.is_reference.to_string());
        for metric in Metric::all() {
            let value = case.measured(metric).value();
            let cell = row.get(metric.name().as_str()).copied().unwrap_or_default();
            assert_eq!(cell.parse().ok(), value, "{metric} of {}", case.name());
        }
    }
}

#[test]
fn markdown_is_the_printed_table_and_a_dash_prints_it_alone() {
    let sandbox = Sandbox::measured();
    let ranking = sandbox.measure("--filters identity --markdown -");
    let due =
        "| plate | FLIP | still | grain |\n|---|---|---|---|\n| **trailing shutter** |  |  |  |\n";
    assert!(ranking.starts_with(due), "{ranking}");
    assert!(
        ranking.lines().all(|line| line.starts_with('|')),
        "{ranking}"
    );
    let cases = sandbox.measure("--filters identity --markdown - --table");
    assert!(cases.starts_with("| scene / filter | FLIP |"), "{cases}");
    let printed = sandbox.measure("--filters identity --markdown ranking.md");
    assert_eq!(sandbox.text("ranking.md"), ranking);
    assert!(printed.contains("report: out/report.html"));
}

#[test]
fn compare_writes_each_change_and_its_tables() {
    let sandbox = Sandbox::gathered();
    sandbox.measure("--filters velocity_gather:fine --set velocity_gather.samples=2");
    let text = sandbox.done("compare --csv -");
    let rows = read_csv(&text);
    let is_flip = |row: &&BTreeMap<&str, &str>| {
        row["filter"] == "velocity_gather:fine" && row["metric"] == "flip_moving"
    };
    let flip = rows.iter().find(is_flip).unwrap();
    assert_eq!([flip["scene"], flip["verdict"]], ["plate", "worse"]);
    let number = |title: &str| flip[title].parse::<f64>().unwrap();
    let change = number("second") - number("first");
    assert!(
        (change - number("change")).abs() < 1e-12 && change > 0.0,
        "{flip:?}"
    );
    assert!(
        number("low") < change && change < number("high"),
        "{flip:?}"
    );
    sandbox.done("compare --markdown changes.md");
    let markdown = sandbox.text("changes.md");
    assert!(
        markdown.contains("| **plate / velocity_gather:fine** |"),
        "{markdown}"
    );
    assert!(markdown.contains("| flip_moving |"), "{markdown}");
}
