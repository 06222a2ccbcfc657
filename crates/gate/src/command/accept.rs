//! The command `limits accept`.

use std::path::PathBuf;
use terminal::refuse;

use clap::Args;
use measure::{Error, Run, find_newer_sizes, printable_path, refuse_failures};

use crate::{Acceptance, Baseline, accept_scores};
use terminal::arguments::parse_glob;
use terminal::output::{count_text, print, print_note};

/// Arguments of `limits accept`.
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

/// Writes the scores of a finished run into the baseline.
pub fn execute(args: &AcceptArgs) -> Result<(), Error> {
    let in_ci = std::env::var("CI").is_ok_and(|value| value == "true" || value == "1");
    if in_ci && !args.force {
        refuse!(
            "CI is set: a check would accept itself; accept on a machine of your own and commit the baseline, or add --force"
        );
    }
    let reason = args.reason.trim();
    if reason.is_empty() || reason.contains('\n') {
        refuse!("--reason: needs one line on why these scores are right");
    }
    let path = args.out.join("run.json");
    let run = Run::read(&path)?;
    refuse_failures(&run.failures)?;
    let old = if args.baseline.exists() {
        Some(Baseline::read(&args.baseline)?)
    } else {
        None
    };
    let acceptance = Acceptance {
        only: args.only.as_ref(),
        reason,
        forced: args.force,
    };
    let baseline = accept_scores(&run, old, &acceptance)?;
    baseline.write(&args.baseline)?;
    let accepted = run.cases.iter().filter(|case| acceptance.includes(case));
    print(format!(
        "written: {}, from {} ({} at {}x{})\n",
        printable_path(&args.baseline),
        printable_path(&path),
        count_text(accepted.count(), "case", "cases"),
        run.render.width,
        run.render.height
    ))?;
    for folder in find_newer_sizes(&args.out) {
        print_note(&format!(
            "{0} is newer, and is not accepted; to accept it instead: --out {0}",
            folder.display()
        ));
    }
    Ok(())
}
