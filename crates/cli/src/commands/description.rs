//! The commands `completions` and `man`, which describe the program.

use std::path::PathBuf;

use clap::Args;
use clap_complete::Shell;
use frame::FileError;
use measure::{Error, printable_path};

use terminal::output::{print, write_out};

#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// Shell: bash, elvish, fish, powershell or zsh.
    #[arg(value_name = "SHELL", hide_possible_values = true)]
    pub shell: Shell,
}

/// Prints the completions of the program for a shell.
pub fn print_completions(args: &CompletionsArgs, mut program: clap::Command) -> Result<(), Error> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut program, "shuttertruth", &mut text);
    // Printed unchanged: a script is no table, and goes to a file.
    write_out(std::io::stdout(), &text)
}

#[derive(Debug, Args)]
pub struct ManArgs {
    /// Folder for the pages: shuttertruth.1, and one for each command.
    #[arg(short, long, value_name = "DIR", default_value = "man")]
    pub out: PathBuf,
}

/// Writes a manual page for the program and for each command.
pub fn write_manual(args: &ManArgs, program: clap::Command) -> Result<(), Error> {
    let fail = |source| FileError::io(&args.out, "write", source);
    std::fs::create_dir_all(&args.out).map_err(fail)?;
    clap_mangen::generate_to(program, &args.out).map_err(fail)?;
    print(format!("written: {}\n", printable_path(&args.out)))
}
