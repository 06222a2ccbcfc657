//! The command `completions`.

use std::io::Write;

use clap::Args;
use clap_complete::Shell;
use suite::Error;

#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// Shell: bash, elvish, fish, powershell or zsh.
    #[arg(value_name = "SHELL", hide_possible_values = true)]
    pub shell: Shell,
}

/// Prints the completions of the program for a shell.
pub fn execute(args: &CompletionsArgs, mut program: clap::Command) -> Result<(), Error> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut program, "shuttertruth", &mut text);
    // As it is: a script is no table, and goes to a file.
    match std::io::stdout().write_all(&text) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            refuse!("standard output: cannot write: {error}")
        }
        _ => Ok(()),
    }
}
