//! Arguments of `serve`.

use clap::Args;

use super::candidate::CandidateArgs;

/// `shuttertruth serve`
#[derive(Debug, Args)]
pub struct ServeArgs {
    #[command(flatten)]
    pub candidate: CandidateArgs,
}
