//! Tests that compare pages with the command line, which is private to this crate: the page of all
//! commands, and every command in a guide.

use std::fs;
use std::iter::once;
use std::path::{Path, PathBuf};

use clap::{Arg, Args, Command, CommandFactory, Id, Parser};

use crate::program::Cli;
use terminal::arguments::{
    AdapterArgs, MeasureArgs, ProgramArgs, RootArgs, RunOptions, SceneArgs, SequenceArgs,
};
use terminal::output::OutputArgs;
use terminal::settings::Settings;

/// Columns of help on the page of all commands.
const WIDTH: usize = 100;

#[test]
fn the_command_line_is_consistent() {
    Cli::command().debug_assert();
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Reads all pages with commands.
fn read_pages() -> Vec<String> {
    let root = root();
    let mut paths: Vec<PathBuf> = ["README.md", "scenes/README.md", "shaders/README.md"]
        .map(|page| root.join(page))
        .to_vec();
    for folder in ["docs", "docs/engines", "crates/engine/guides"] {
        for guide in fs::read_dir(root.join(folder)).unwrap() {
            let path = guide.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "md") {
                paths.push(path);
            }
        }
    }
    let crates = fs::read_dir(root.join("crates")).unwrap();
    let guides = crates.map(|entry| entry.unwrap().path().join("README.md"));
    paths.extend(guides.filter(|path| path.is_file()));
    let pages = paths.iter().map(|path| fs::read_to_string(path).unwrap());
    pages.collect()
}

/// Lists the commands of a page as words: lines of their own, and text in backquotes. Skips
/// commands with shell variables.
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
        // A bare command name is a mention, not an example.
        .filter(|text| text.split_whitespace().count() > 3);
    (lines.chain(quoted))
        .filter(is_command)
        .map(split_words)
        .collect()
}

/// Splits a line as a shell does, without output redirection.
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
        // Help and the version also end parsing.
        if let Err(error) = Cli::try_parse_from(&command)
            && error.use_stderr()
        {
            panic!("{}: {error}", command.join(" "));
        }
    }
}

/// Adds the arguments of a group to a command.
type Group = fn(Command) -> Command;

/// Arguments that commands share: their heading on the page, and their group. A group comes after
/// the groups that it includes.
const SHARED: [(&str, Group); 9] = [
    ("Every command", OutputArgs::augment_args),
    ("Scene folder", RootArgs::augment_args),
    ("Programs", ProgramArgs::augment_args),
    ("Adapter", AdapterArgs::augment_args),
    ("Scenes", SceneArgs::augment_args),
    ("Measurement", MeasureArgs::augment_args),
    ("Sequences", SequenceArgs::augment_args),
    ("Intervals", RunOptions::augment_args),
    ("Candidate", tune::CandidateArgs::augment_args),
];

/// Makes the page of all commands: its own introduction, each command's help, and the shared
/// arguments.
fn commands_page(written: &str) -> String {
    let program = Cli::command_line(&Settings::default());
    let mut text = written.split("\n## ").next().unwrap().to_owned();
    let below = (program.get_subcommands()).filter(|command| command.get_name() != "help");
    let below = below.flat_map(|command| once(command).chain(command.get_subcommands()));
    let all: Vec<&Command> = once(&program).chain(below).collect();
    for command in &all {
        text += &describe(command);
    }
    for (title, _) in SHARED {
        let mut shared = all.iter().flat_map(|command| {
            let groups = list_shared(command).into_iter();
            groups.map(move |(group, ids)| (command, group, ids))
        });
        let (command, _, ids) = shared.find(|(_, group, _)| *group == title).expect(title);
        text += &format!(
            "\n## {title}\n\n{}",
            help(command, "{positionals}\n{options}", &ids)
        );
    }
    text
}

/// Lists the complete groups of a command, each with the arguments that no earlier group has.
fn list_shared(command: &Command) -> Vec<(&'static str, Vec<Id>)> {
    let has = |arg: &Arg| {
        let is_same =
            |other: &Arg| other.get_id() == arg.get_id() && other.get_help() == arg.get_help();
        command.get_arguments().any(is_same)
    };
    let mut taken = Vec::new();
    let mut groups = Vec::new();
    for (title, group) in SHARED {
        let group = group(Command::new("group"));
        if group.get_arguments().all(has) {
            let ids = group.get_arguments().map(|arg| arg.get_id().clone());
            let ids: Vec<Id> = ids.filter(|id| !taken.contains(id)).collect();
            taken.extend(ids.iter().cloned());
            groups.push((title, ids));
        }
    }
    groups
}

/// Describes a command: its purpose, its own arguments, and links to shared ones.
fn describe(command: &Command) -> String {
    let name = command.get_bin_name().unwrap_or("shuttertruth");
    let heading = format!("\n## {name}\n\n{}.\n", command.get_about().unwrap());
    if command.has_subcommands() && name != "shuttertruth" {
        return heading;
    }
    let shared = list_shared(command);
    let is_own = |id: &Id| *id != "help" && !shared.iter().any(|(_, ids)| ids.contains(id));
    let listed = command.get_arguments().map(|arg| arg.get_id().clone());
    let listed: Vec<Id> = listed.filter(is_own).collect();
    let titles = shared.iter().map(|(title, _)| title);
    let links: Vec<String> = (titles.skip(1))
        .map(|title| format!("[{title}](#{})", title.to_lowercase().replace(' ', "-")))
        .collect();
    let links = match links.as_slice() {
        [] => String::new(),
        links => format!("\nShared: {}\n", links.join(", ")),
    };
    let usage = command.clone().render_usage().to_string();
    let template = usage.replace("Usage: ", "") + "\n\n{all-args}";
    format!("{heading}\n{}{links}", help(command, &template, &listed))
}

/// Renders the help of some arguments of a command as a block.
fn help(command: &Command, template: &str, listed: &[Id]) -> String {
    let hide = |argument: Arg| {
        let is_hidden = argument.is_hide_set() || !listed.contains(argument.get_id());
        argument.hide(is_hidden)
    };
    let command = command.clone().term_width(WIDTH).mut_args(hide);
    let help = command
        .help_template(template.to_owned())
        .render_help()
        .to_string();
    let lines = help.trim_matches('\n').lines().map(str::trim_end);
    let lines = lines.collect::<Vec<_>>();
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
