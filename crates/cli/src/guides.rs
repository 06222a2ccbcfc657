//! Tests that hold pages to the command line, which nobody outside of this crate can see: the page of all commands, and every command
//! that a guide shows.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Command, CommandFactory, Parser};

use crate::program::Cli;

/// Columns of the help on the page of all commands.
const WIDTH: usize = 100;

#[test]
fn the_command_line_is_consistent() {
    Cli::command().debug_assert();
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Reads all pages that show commands.
fn read_pages() -> Vec<String> {
    let root = root();
    let mut paths: Vec<PathBuf> = ["README.md", "scenes/README.md", "shaders/README.md"]
        .map(|page| root.join(page))
        .to_vec();
    for folder in ["docs", "docs/engines"] {
        for guide in fs::read_dir(root.join(folder)).unwrap() {
            let path = guide.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "md") {
                paths.push(path);
            }
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

/// Splits a line as a shell does, without the file that the output goes to.
fn split_words(line: &str) -> Vec<String> {
    let words = shlex::split(line).unwrap_or_else(|| panic!("{line}: no words"));
    words.into_iter().take_while(|word| word != ">").collect()
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

/// Makes the page of all commands: its own introduction, then the help.
fn commands_page(written: &str) -> String {
    let program = Cli::command_line();
    let introduction = written.split("\n## ").next().unwrap_or_default();
    let mut text = introduction.to_owned() + &help(&program);
    let commands = program.get_subcommands();
    for command in commands.filter(|own| own.get_name() != "help") {
        text += &help(command);
        text.extend(command.get_subcommands().map(help));
    }
    text
}

fn help(command: &Command) -> String {
    let mut command = command.clone().term_width(WIDTH);
    let name = command.get_bin_name().unwrap_or("shuttertruth").to_owned();
    let help = command.render_help().to_string();
    let lines = help.lines().map(str::trim_end).collect::<Vec<_>>();
    format!("\n## {name}\n\n```text\n{}\n```\n", lines.join("\n"))
}

#[test]
fn the_page_of_commands_is_the_help() {
    let written = fs::read_to_string(root().join("docs/commands.md")).unwrap();
    let expected = commands_page(&written);
    if written != expected {
        let fresh = std::env::temp_dir().join("commands.md");
        fs::write(&fresh, expected).unwrap();
        panic!(
            "docs/commands.md is not what the help says; copy {} over it",
            fresh.display()
        );
    }
}
