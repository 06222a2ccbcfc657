//! The tables of scores in README.md, docs/results.md and docs/first-ten-minutes.md, against the
//! program's output.

use std::fs;
use std::path::Path;

use tests::root;
use tests::text::squeeze;

use super::page::{Step, find_steps};
use super::reader::Reader;
use crate::sandbox::{assert_done, stdout};

const README: &str = include_str!("../../../README.md");
const RESULTS: &str = include_str!("../../../docs/results.md");

/// The tables of all presets, which docs/results.md shows in part.
const ALL: &str = include_str!("run_tables.txt");

/// Scenes of `make run`.
const RUN: &str = "shuttertruth run --quiet sliding_panel panel_over_texture two_spheres railing fan \
                   --samples-per-pixel 64";

/// Lists the lines of a page's tables of scores.
fn find_rows(page: &str) -> Vec<&str> {
    let blocks = page.split("\n\n");
    let tables = blocks.filter(|block| {
        let head = block.trim_start();
        block.starts_with("    ") && (head.starts_with("mean over") || head.starts_with("scene /"))
    });
    let rows = tables.flat_map(str::lines).map(|line| &line[4..]);
    rows.filter(|row| *row != "..").collect()
}

#[test]
fn the_ranking_of_the_readme_has_the_means_of_the_results() {
    for row in find_rows(RESULTS) {
        assert!(ALL.lines().any(|line| line == row), "{row}");
    }
    // A long name has a line of its own.
    let results = squeeze(ALL);
    let ranking = find_rows(README).join(" ");
    let words: Vec<&str> = ranking.split_whitespace().collect();
    let mut count = 0;
    for row in words.windows(7) {
        // A preset, its mean, change of what stands still, grain, the interval.
        if let [preset, mean, still, grain, low, "to", high] = *row {
            let grain = grain.trim_end_matches('!');
            // No blur is a reference in the tables of all scores.
            let name = if preset == "blur" {
                "[identity]"
            } else {
                preset
            };
            let row = format!(" {name} {mean} {low} to {high} {still} {grain} ");
            assert!(results.contains(&row), "no table has \"{row}\"");
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
    if !has_adapter_of_the_pages(&printed[0]) {
        return;
    }
    let lines: Vec<&str> = printed.iter().flat_map(|text| text.lines()).collect();
    let kept = ALL.lines().filter(|line| !line.is_empty());
    for row in find_rows(README).into_iter().chain(kept) {
        assert!(
            lines.contains(&row),
            "`run` does not print \"{row}\"; it prints:\n{}",
            printed.join("\n")
        );
    }
}

/// Returns whether a run used the adapter of the pages' scores.
fn has_adapter_of_the_pages(printed: &str) -> bool {
    let adapter = printed.split("adapter: ").nth(1).unwrap();
    let driver = adapter.split(',').next().unwrap();
    let is_own = RESULTS.contains(driver);
    if !is_own {
        eprintln!("not compared: the pages have the scores of another adapter than {driver}");
    }
    is_own
}

/// Lists all lines in a page's blocks.
fn find_shown(page: &str) -> Vec<&str> {
    let lines = page.lines().filter_map(|line| line.strip_prefix("    "));
    lines.collect()
}

/// Runs the commands that make a page's tables, and compares each line of the tables with their
/// output.
fn assert_printed(path: &Path, find_rows: fn(&str) -> Vec<&str>, least: usize) {
    let reader = Reader::new();
    let page = fs::read_to_string(path).unwrap();
    let mut printed = String::new();
    let mut commands = Vec::new();
    for step in find_steps(&page) {
        if let Step::Run(command) = step
            && [
                "shuttertruth new",
                "shuttertruth run",
                "shuttertruth list",
                "shuttertruth compare",
                "cp ",
            ]
            .iter()
            .any(|start| command.starts_with(start))
            && !command.contains("1920x1080")
            && !super::is_left_out(&command)
        {
            let output = reader.run(&command);
            assert_done(&output);
            printed += &stdout(&output);
            commands.push(command);
        }
    }
    if !has_adapter_of_the_pages(&printed) {
        return;
    }
    let lines: Vec<String> = printed.lines().map(squeeze).collect();
    let mut rows = find_rows(&page);
    rows.retain(|row| *row != ".." && !commands.iter().any(|command| command == row));
    assert!(rows.len() >= least, "only {} lines are shown", rows.len());
    for row in rows {
        let name = path.display();
        let is_printed = lines.iter().any(|line| line.starts_with(&squeeze(row)));
        assert!(
            is_printed,
            "{name}: no command prints \"{row}\"; they print:\n{printed}"
        );
    }
}

#[test]
#[ignore = "prove: what the first ten minutes and the pages of engines show, as their commands print it"]
fn the_tutorials_show_what_their_commands_print() {
    assert_printed(&root().join("docs/first-ten-minutes.md"), find_shown, 16);
    // Blender's page scores a picture, and ranks nothing.
    for engine in ["bevy", "godot", "three", "unity"] {
        let page = root().join("docs/engines").join(engine);
        assert_printed(&page.with_extension("md"), find_rows, 4);
    }
}
