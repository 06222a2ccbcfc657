//! Tests of the command line itself, and of every command that the guides show.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{CommandFactory, Parser};

use crate::program::Cli;

#[test]
fn the_command_line_is_consistent() {
    Cli::command().debug_assert();
}

/// Reads all pages that show commands.
fn read_pages() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut paths: Vec<PathBuf> = ["README.md", "scenes/README.md", "shaders/README.md"]
        .map(|page| root.join(page))
        .to_vec();
    for guide in fs::read_dir(root.join("docs")).unwrap() {
        let path = guide.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "md") {
            paths.push(path);
        }
    }
    let pages = paths.iter().map(|path| fs::read_to_string(path).unwrap());
    pages.collect()
}

/// Lists the commands of a page, each split into words: lines of their own, and those in backquotes. Commands with shell
/// variables are left out.
fn find_commands(page: &str) -> Vec<Vec<String>> {
    let joined = page.replace("\\\n", " ");
    let is_command = |text: &&str| {
        let is_help = text.starts_with("shuttertruth help");
        text.starts_with("shuttertruth ") && !is_help && !text.contains('$')
    };
    let lines = joined.lines().filter_map(|line| line.strip_prefix("    "));
    let quoted = joined
        .lines()
        .flat_map(|line| line.split('`').skip(1).step_by(2))
        // A command by its name alone is spoken of, and not shown.
        .filter(|text| text.split_whitespace().count() > 3);
    (lines.chain(quoted))
        .filter(is_command)
        .map(split_words)
        .collect()
}

/// Splits a line as a shell does, with quotes, comments, and a file that the output goes to.
fn split_words(line: &str) -> Vec<String> {
    let command = line.split(" #").next().unwrap_or_default();
    let command = command.split(" > ").next().unwrap_or_default();
    let parts = command.split(['"', '\'']).enumerate();
    let words = parts.flat_map(|(index, part)| match index % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

#[test]
fn every_command_that_the_guides_show_is_one() {
    let all: Vec<Vec<String>> = (read_pages().iter())
        .flat_map(|page| find_commands(page))
        .collect();
    assert!(all.len() > 40, "only {} commands were found", all.len());
    for command in all {
        if let Err(error) = Cli::try_parse_from(&command) {
            panic!("{}: {error}", command.join(" "));
        }
    }
}
