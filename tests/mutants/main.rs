//! A mutation score of the limits: changes of the shipped kernels, and the share that a check notices. results/studies/mutation.md
//! explains how to use it.

mod bench;
mod change;
mod journal;
mod limits;
mod measure;
mod options;
mod study;
mod subject;
mod table;
mod verdict;

use std::collections::BTreeMap;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use bench::Bench;
use clap::Parser;
use journal::Journal;
use options::Options;
use study::Study;
use subject::Subject;
use suite::Error;

fn main() -> ExitCode {
    match execute(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("mutants: {error}");
            ExitCode::from(2)
        }
    }
}

/// Measures every mutant of every filter that no earlier run has measured, and prints the score.
fn execute(options: &Options) -> Result<(), Error> {
    let minutes = options.minutes.map(|it| Duration::from_secs(60 * it));
    let deadline = minutes.map(|time| Instant::now() + time);
    let due = || deadline.is_none_or(|deadline| Instant::now() < deadline);
    let subjects = (options.filters.iter())
        .map(|filter| Subject::new(filter, options.count))
        .collect::<Result<Vec<_>, _>>()?;
    let mut bench = Bench::open(options, &subjects)?;
    let mut journal = Journal::open(&bench.out)?;
    let mut all = Vec::new();
    for subject in &subjects {
        let mut study = Study {
            bench: &mut bench,
            subject,
            journal: &mut journal,
            limits: BTreeMap::new(),
            due: &due,
        };
        study.measure_changes()?;
        study.find_limits()?;
        study.measure_mutants()?;
        study.widen_limits()?;
        let verdicts = study.find_verdicts();
        print!("{}", table::format_subject(&study, &verdicts));
        all.extend(verdicts);
    }
    if subjects.len() > 1 {
        print!("{}", table::format_total(&all));
    }
    Ok(())
}
