//! What filters run on: an adapter, or programs of their own.

use clap::Args;

use crate::selection::Programs;

/// Permission to run filters that are programs.
#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "Filters")]
pub struct ProgramArgs {
    /// Run filters that are programs. They can do whatever you can: read their filter.toml first.
    #[arg(long)]
    pub allow_commands: bool,
}

impl ProgramArgs {
    /// Returns the permission for selecting filters.
    pub fn programs(self) -> Programs {
        if self.allow_commands {
            Programs::Allowed
        } else {
            Programs::Refused
        }
    }
}

/// Choice of the adapter.
#[derive(Debug, Args)]
#[command(next_help_heading = "Adapter")]
pub struct AdapterArgs {
    /// Adapter that filters run on: its number in `list adapters`, or part of its name [default:
    /// the fastest].
    #[arg(long, value_name = "ADAPTER")]
    pub adapter: Option<String>,
}
