//! Arguments of `accept`.

use std::path::PathBuf;

use clap::Args;

use super::parse::parse_glob;

/// `shuttertruth accept`
#[derive(Debug, Args)]
pub struct AcceptArgs {
    /// Folder of the finished run: --out of `run` or `check`.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Reason why these scores are right, in one line.
    #[arg(long, value_name = "TEXT")]
    pub reason: String,
    /// Cases to accept, by scene/filter:preset, such as 'fan/*' or '*/jump_flood:*' [default: all].
    #[arg(long, value_name = "GLOB", value_parser = parse_glob)]
    pub only: Option<glob::Pattern>,
    /// File to write, or to change with --only.
    #[arg(long, value_name = "FILE", default_value = "base.json")]
    pub baseline: PathBuf,
    /// Accept even in CI (CI=true), or on another class of adapter than the baseline's.
    #[arg(long)]
    pub force: bool,
}
