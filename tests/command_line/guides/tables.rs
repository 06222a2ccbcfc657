//! The tables of scores that README.md and docs/results.md show, against what `run` prints.

use tests::text::squeeze;

use super::reader::Reader;
use crate::sandbox::{assert_done, stdout};

const README: &str = include_str!("../../../README.md");
const RESULTS: &str = include_str!("../../../docs/results.md");

/// The scenes that `make run` takes.
const RUN: &str =
    "shuttertruth run --quiet --scenes sliding_panel,panel_over_texture,two_spheres,railing,fan";

/// Lists the lines of a page's tables of scores.
fn find_rows(page: &str) -> Vec<&str> {
    let blocks = page.split("\n\n");
    let tables = blocks.filter(|block| {
        let head = block.trim_start();
        block.starts_with("    ") && (head.starts_with("mean over") || head.starts_with("scene /"))
    });
    tables.flat_map(str::lines).map(|line| &line[4..]).collect()
}

#[test]
fn the_ranking_of_the_readme_has_the_means_of_the_results() {
    let results: Vec<String> = find_rows(RESULTS).into_iter().map(squeeze).collect();
    let mut count = 0;
    for row in find_rows(README) {
        // A rank, a preset, its mean, the interval, the worst scene with its score.
        let words: Vec<&str> = row.split_whitespace().collect();
        if let [_, preset, mean, low, "to", high, _, _] = words[..] {
            let start = format!("{preset} {mean} {low} to {high} ");
            let agrees = results.iter().any(|line| line.starts_with(&start));
            assert!(agrees, "docs/results.md has no line \"{start}..\"");
            count += 1;
        }
    }
    assert!(count > 8, "README.md ranks only {count} filters");
}

#[test]
#[ignore = "prove: the tables of the pages, as `run` prints them"]
fn the_tables_are_what_run_prints() {
    let reader = Reader::new();
    let printed = [format!("{RUN} --table"), RUN.to_owned()].map(|command| {
        let output = reader.run(&command);
        assert_done(&output);
        stdout(&output)
    });
    let adapter = printed[0].split("adapter: ").nth(1).unwrap();
    let driver = adapter.split(',').next().unwrap();
    if !RESULTS.contains(driver) {
        eprintln!("not compared: the pages have the scores of another adapter than {driver}");
        return;
    }
    let lines: Vec<&str> = printed.iter().flat_map(|text| text.lines()).collect();
    for row in [README, RESULTS].into_iter().flat_map(find_rows) {
        assert!(
            lines.contains(&row),
            "`run` does not print \"{row}\"; it prints:\n{}",
            printed.join("\n")
        );
    }
}
