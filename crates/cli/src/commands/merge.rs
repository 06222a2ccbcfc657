//! The command `merge`.

use judge::JUDGEMENT_FILE;
use store::printable_path;
use suite::{Error, holds_run, merge, merge_runs, refuse_failures};

use super::run_files::write_run;
use crate::arguments::MergeArgs;
use crate::output::count::count_text;
use crate::output::print::print;
use crate::tables::failures::failures_text;

/// Joins runs where every part is one, and replicates otherwise; prints the run, or the truths, that they made.
pub fn execute(args: &MergeArgs) -> Result<(), Error> {
    match args.parts.iter().all(|part| holds_run(part)) {
        true => join_runs(args),
        false => join_replicates(args),
    }
}

fn join_replicates(args: &MergeArgs) -> Result<(), Error> {
    for merged in merge(&args.parts, &args.out)? {
        print(&format!(
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
    let merged = merge_runs(&args.parts, command, &args.out)?;
    // It would be about another run.json.
    let _ = std::fs::remove_file(args.out.join(JUDGEMENT_FILE));
    write_run(&merged.run, &args.out)?;
    let run = &merged.run;
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
