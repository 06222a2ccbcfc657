//! Groups of commands, in the order in which the help and the page of commands list them.

use clap::{Command, CommandFactory};

use super::Cli;
use crate::output::wrap::push_wrapped;

/// A heading, and its commands.
pub struct Group {
    /// Heading: what a user wants to do.
    pub heading: &'static str,
    /// Names of the commands.
    pub commands: &'static [&'static str],
}

/// All commands.
pub const GROUPS: [Group; 8] = [
    Group {
        heading: "Measure",
        commands: &["run", "score", "bench"],
    },
    Group {
        heading: "Judge",
        commands: &["check", "accept", "calibrate"],
    },
    Group {
        heading: "Look",
        commands: &["report", "compare", "list"],
    },
    Group {
        heading: "Ask people",
        commands: &["ask", "preferences"],
    },
    Group {
        heading: "Tune",
        commands: &[
            "tune",
            "sensitivity",
            "compare-presets",
            "evaluate",
            "serve",
        ],
    },
    Group {
        heading: "Move scenes in and out",
        commands: &["import", "export", "ingest", "audit"],
    },
    Group {
        heading: "Share the work, or do one step of it",
        commands: &["plan", "merge", "render", "pack", "verify", "blur"],
    },
    Group {
        heading: "Set up",
        commands: &["completions", "man"],
    },
];

/// Lists the names of the commands, in the order of the help.
pub fn list_commands() -> Vec<String> {
    let names = GROUPS.iter().flat_map(|group| group.commands);
    names.map(|name| (*name).to_owned()).collect()
}

/// Column at which a command's description begins.
const DESCRIPTIONS: usize = 19;

/// Makes the command line without groups, for completions and the manual: all commands are visible.
pub fn visible_command_line() -> Command {
    Cli::command().mut_subcommands(allow_negative_numbers)
}

/// Makes the command line, whose help lists the commands by their groups.
pub fn command_line() -> Command {
    let program = Cli::command();
    let groups = groups_text(&program);
    (program.mut_subcommands(|command| allow_negative_numbers(command).hide(true)))
        .override_usage("shuttertruth [OPTIONS] <COMMAND>")
        .help_template(format!(
            "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{groups}{{all-args}}\n\n\
             shuttertruth help <COMMAND> says more about a command."
        ))
}

/// Takes a number below 0 for the value of an option, which then says what is allowed.
fn allow_negative_numbers(command: Command) -> Command {
    command.mut_args(|arg| {
        let has_value = arg.get_action().takes_values() && !arg.is_positional();
        match has_value && !arg.is_allow_hyphen_values_set() {
            true => arg.allow_negative_numbers(true),
            false => arg,
        }
    })
}

/// Lists the commands of each group, wrapped to the terminal.
fn groups_text(program: &Command) -> String {
    let style = program.get_styles().get_header();
    let mut text = String::new();
    for Group { heading, commands } in &GROUPS {
        text += &format!("{style}{heading}:{style:#}\n");
        for name in *commands {
            let command = program
                .find_subcommand(name)
                .expect("a group lists commands");
            let about = command.get_about().cloned().unwrap_or_default().to_string();
            let mut description = String::new();
            push_wrapped(&mut description, DESCRIPTIONS, &about);
            text += &format!("  {name:0$}", DESCRIPTIONS - 2);
            text += &description[DESCRIPTIONS..];
        }
        text += "\n";
    }
    text
}

#[test]
fn every_command_is_in_one_group() {
    let mut sorted = list_commands();
    sorted.sort_unstable();
    let program = Cli::command();
    let mut known: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
    known.sort_unstable();
    assert_eq!(sorted, known);
}
