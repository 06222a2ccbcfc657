//! Argument that chooses the adapter.

use clap::Args;

/// Choice of the adapter.
#[derive(Debug, Args)]
#[command(next_help_heading = "Adapter")]
pub struct AdapterArgs {
    /// Adapter that filters run on: its number in `list adapters`, or part of its name [default: the fastest].
    #[arg(long, value_name = "ADAPTER")]
    pub adapter: Option<String>,
}
