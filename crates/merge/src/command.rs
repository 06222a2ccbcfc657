//! The command `truths merge`.

use std::path::PathBuf;

use clap::Args;
use judge::JUDGEMENT_FILE;
use measure::{Error, printable_path, refuse_failures};
use run::{failures_text, write_run};
use terminal::output::{count_text, print};

use crate::runs::{holds_run, merge_runs};
use crate::truths::merge_truths;

/// Arguments of `truths merge`.
#[derive(Debug, Args)]
pub struct MergeArgs {
    /// Folders that `render --replicates A..B` wrote, or folders of finished runs, each with other
    /// scenes or filters.
    #[arg(required = true, value_name = "FOLDER")]
    pub parts: Vec<PathBuf>,
    /// Folder for the whole, as one machine would have written it.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Command line that run.json records [default: this command's].
    #[arg(last = true, value_name = "COMMAND")]
    pub command: Vec<String>,
}

/// Joins runs if every part is one, or else replicates; prints the run or the truths.
pub fn execute(args: &MergeArgs) -> Result<(), Error> {
    if args.parts.iter().all(|part| holds_run(part)) {
        join_runs(args)
    } else {
        join_replicates(args)
    }
}

fn join_replicates(args: &MergeArgs) -> Result<(), Error> {
    for merged in merge_truths(&args.parts, &args.out)? {
        print(format!(
            "{} ({} replicates)\n",
            printable_path(&merged.truth),
            merged.replicates
        ))?;
    }
    Ok(())
}

fn join_runs(args: &MergeArgs) -> Result<(), Error> {
    let command = match args.command.as_slice() {
        [] => std::env::args().collect(),
        words => words.to_vec(),
    };
    let (run, _lock) = merge_runs(&args.parts, command, &args.out)?;
    // An earlier judgement there is about another run.json.
    let _ = std::fs::remove_file(args.out.join(JUDGEMENT_FILE));
    write_run(&run, &args.out)?;
    let mut text = failures_text(&run.failures);
    text += &format!(
        "{} ({} of {})\n",
        printable_path(&args.out.join("run.json")),
        count_text(run.cases.len() + run.failures.len(), "case", "cases"),
        count_text(args.parts.len(), "part", "parts")
    );
    print(&text)?;
    refuse_failures(&run.failures)
}
