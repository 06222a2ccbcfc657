//! The page of all commands, held to the help of the program.

use std::fmt::Write;
use std::path::Path;

use clap::Command;

use crate::program::Cli;

/// Columns of the help on the page.
const WIDTH: usize = 100;

/// Makes the page: its own introduction, then the help.
fn page(written: &str) -> String {
    let program = Cli::command_line().term_width(WIDTH);
    let introduction = written.split("\n## ").next();
    let mut text = introduction.unwrap_or_default().to_owned();
    push_help(&mut text, program.clone());
    let commands = program.get_subcommands();
    for command in commands.filter(|own| own.get_name() != "help") {
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
    let expected = page(&written);
    if written != expected {
        let fresh = std::env::temp_dir().join("commands.md");
        std::fs::write(&fresh, expected).unwrap();
        panic!(
            "docs/commands.md is not what the help says; copy {} over it",
            fresh.display()
        );
    }
}
