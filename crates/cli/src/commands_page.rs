//! The page of all commands, held to the help of the program.

use std::fmt::Write;
use std::path::Path;

use clap::Command;

use crate::program::Cli;

/// Columns of the help on the page.
const WIDTH: usize = 100;

const INTRODUCTION: &str = "\
# Commands

`-h` behind a command prints the same, and `--help` says more. Results go to standard output, progress and errors to standard error.

| exit code | meaning |
|---|---|
| 0 | done; `check`: every required bound is met; `tune search`: also where it advises to keep the start, and writes no preset.toml |
| 1 | `check`: a required bound is broken, a score is worse than the baseline's by more than its margin, or a case failed; `engine audit`: velocity, depth or colour is wrong |
| 2 | usage or bad input; bounds that are wrong, missing, or stricter than the noise of the truth can carry; `engine audit`: the capture does not show the scene |
| 3 | no adapter |
| 4 | too noisy: `check` cannot decide, or `truths render` did not reach `--noise` |
| 130, 143, 129 | interrupted by SIGINT (Ctrl-C), SIGTERM or SIGHUP; the same command goes on from there |
";

/// Makes the page from the help.
fn page() -> String {
    let program = Cli::command_line().term_width(WIDTH);
    let mut text = INTRODUCTION.to_owned();
    push_help(&mut text, program.clone());
    for command in program
        .get_subcommands()
        .filter(|own| own.get_name() != "help")
    {
        push_help(&mut text, command.clone());
        for command in command.get_subcommands() {
            push_help(&mut text, command.clone());
        }
    }
    text
}

fn push_help(text: &mut String, command: Command) {
    let mut command = command.term_width(WIDTH);
    let name = command.get_bin_name().unwrap_or("shuttertruth").to_owned();
    let help = command.render_help().to_string();
    let lines = help.lines().map(str::trim_end).collect::<Vec<_>>();
    let _ = write!(text, "\n## {name}\n\n```text\n{}\n```\n", lines.join("\n"));
}

#[test]
fn the_page_of_commands_is_the_help() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let written = std::fs::read_to_string(root.join("docs/commands.md")).unwrap_or_default();
    let expected = page();
    if written != expected {
        let fresh = std::env::temp_dir().join("commands.md");
        std::fs::write(&fresh, expected).unwrap();
        panic!(
            "docs/commands.md is not what the help says; copy {} over it",
            fresh.display()
        );
    }
}
