//! Arguments of `preferences`.

use std::path::PathBuf;

use clap::Args;

/// `shuttertruth preferences`
#[derive(Debug, Args)]
pub struct PreferencesArgs {
    /// Files of answers that the page of `ask` saved, one per session.
    #[arg(value_name = "ANSWERS", required = true)]
    pub answers: Vec<PathBuf>,
    /// run.json of the run that the page was made of, or its folder, with the pictures: compares its scores with the answers.
    #[arg(long, value_name = "RUN")]
    pub run: Option<PathBuf>,
    /// Print all numbers as JSON instead of the tables.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
