//! Tests that hold pages to the command line, which nobody outside of this crate can see: the page of all commands, and every command
//! that a guide shows.

use std::fs;
use std::iter::once;
use std::path::{Path, PathBuf};

use clap::{Arg, Command, CommandFactory, Id, Parser};

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

/// Options that commands share: their heading on the page, and their groups in the code.
const SHARED: [(&str, &[&str]); 9] = [
    ("Every command", &["OutputArgs"]),
    ("Scenes", &["SceneArgs", "FrameRateArgs"]),
    ("Folder of scenes", &["RootArgs"]),
    ("Measurement", &["MeasureArgs", "InputFormArgs"]),
    ("Intervals", &["RunOptions"]),
    ("Sequences", &["SequenceArgs"]),
    ("Candidate", &["CandidateArgs"]),
    ("Programs", &["ProgramArgs"]),
    ("Adapter", &["AdapterArgs"]),
];

/// Makes the page of all commands: its own introduction, the help of each command, and the options that commands share.
fn commands_page(written: &str) -> String {
    let program = Cli::command_line();
    let mut text = written.split("\n## ").next().unwrap().to_owned();
    let below = (program.get_subcommands()).filter(|own| own.get_name() != "help");
    let below = below.flat_map(|own| once(own).chain(own.get_subcommands()));
    let all: Vec<&Command> = once(&program).chain(below).collect();
    for command in &all {
        text += &describe(command);
    }
    for (title, groups) in SHARED {
        let mut members = all.iter().map(|own| (own, list_members(own, groups)));
        let (command, members) = members.find(|(_, ids)| !ids.is_empty()).expect(title);
        text += &format!("\n## {title}\n\n{}", options(command, "", &members));
    }
    text
}

/// Lists the arguments of a command that belong to some groups.
fn list_members(command: &Command, groups: &[&str]) -> Vec<Id> {
    let groups = (command.get_groups()).filter(|own| groups.contains(&own.get_id().as_str()));
    groups.flat_map(|own| own.get_args()).cloned().collect()
}

/// Describes a command: its purpose, its own arguments, and links to those that it shares.
fn describe(command: &Command) -> String {
    let name = command.get_bin_name().unwrap_or("shuttertruth");
    let heading = format!("\n## {name}\n\n{}.\n", command.get_about().unwrap());
    if command.has_subcommands() && name != "shuttertruth" {
        return heading;
    }
    let shared = SHARED.map(|(title, groups)| (title, list_members(command, groups)));
    let is_shared = |id: &Id| shared.iter().any(|(_, ids)| ids.contains(id));
    let own = (command.get_arguments())
        .filter(|own| !own.is_global_set() && own.get_id() != "help")
        .map(|own| own.get_id().clone());
    let own: Vec<Id> = own.filter(|id| !is_shared(id)).collect();
    let links = shared.iter().filter(|(_, ids)| !ids.is_empty());
    let links =
        links.map(|(title, _)| format!("[{title}](#{})", title.to_lowercase().replace(' ', "-")));
    let links = match links.collect::<Vec<_>>() {
        links if links.is_empty() => String::new(),
        links => format!("\nShared: {}\n", links.join(", ")),
    };
    format!(
        "{heading}\n{}{links}",
        options(command, "{usage}\n\n", &own)
    )
}

/// Renders the help of some arguments of a command as a block, below a head.
fn options(command: &Command, head: &str, listed: &[Id]) -> String {
    let usage = command.clone().render_usage().to_string();
    let head = head.replace("{usage}", usage.trim_start_matches("Usage: "));
    let hide = |own: Arg| {
        let is_hidden = own.is_hide_set() || !listed.contains(own.get_id());
        own.hide(is_hidden)
    };
    let command = command.clone().term_width(WIDTH).mut_args(hide);
    let help = (command.help_template("{all-args}").render_help()).to_string();
    let text = head + &help;
    let lines = text.trim().lines().map(str::trim_end).collect::<Vec<_>>();
    format!("```text\n{}\n```\n", lines.join("\n"))
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
