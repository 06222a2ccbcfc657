//! Tests of the command line itself, and of every command that the guides show.

use clap::{CommandFactory, Parser};

use super::Cli;

#[test]
fn the_command_line_is_consistent() {
    Cli::command().debug_assert();
}

/// All pages that show commands.
const PAGES: [&str; 9] = [
    include_str!("../../../../README.md"),
    include_str!("../../../../docs/reading-a-report.md"),
    include_str!("../../../../docs/conventions.md"),
    include_str!("../../../../docs/add-a-filter.md"),
    include_str!("../../../../docs/add-a-scene.md"),
    include_str!("../../../../docs/ci.md"),
    include_str!("../../../../docs/fidelity.md"),
    include_str!("../../../../docs/not-measured.md"),
    include_str!("../../../../scenes/README.md"),
];

/// Lists the commands of a page, each split into words; commands with shell variables are left out.
fn find_commands(page: &str) -> Vec<Vec<String>> {
    let joined = page.replace("\\\n", " ");
    let lines = joined
        .lines()
        .filter(|line| line.starts_with("    shuttertruth "));
    let plain = lines.filter(|line| !line.contains('$'));
    plain.map(split_words).collect()
}

/// Splits a line as a shell does, with quotes and comments.
fn split_words(line: &str) -> Vec<String> {
    let command = line.split(" #").next().unwrap_or_default();
    let parts = command.split(['"', '\'']).enumerate();
    let words = parts.flat_map(|(index, part)| match index % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

#[test]
fn every_command_that_the_guides_show_is_one() {
    let all: Vec<Vec<String>> = PAGES.into_iter().flat_map(find_commands).collect();
    assert!(all.len() > 40, "only {} commands were found", all.len());
    for command in all {
        if let Err(error) = Cli::try_parse_from(&command) {
            panic!("{}: {error}", command.join(" "));
        }
    }
}
