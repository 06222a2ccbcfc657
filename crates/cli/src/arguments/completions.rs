//! Arguments of `completions`.

use clap::Args;
use clap_complete::Shell;

/// `shuttertruth completions`
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// Shell: bash, elvish, fish, powershell or zsh.
    #[arg(value_name = "SHELL", hide_possible_values = true)]
    pub shell: Shell,
}
