//! The command `completions`.

use std::io::Write;

use suite::Error;

use crate::arguments::{CompletionsArgs, visible_command_line};

/// Prints the completions of the program for a shell.
pub fn execute(args: &CompletionsArgs) -> Result<(), Error> {
    let mut text = Vec::new();
    let mut program = visible_command_line();
    clap_complete::generate(args.shell, &mut program, "shuttertruth", &mut text);
    // As it is: a script is no table, and goes to a file.
    match std::io::stdout().write_all(&text) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Error::Usage(format!(
            "standard output: cannot write: {error}"
        ))),
        _ => Ok(()),
    }
}
