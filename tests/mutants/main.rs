//! A mutation score of the limits: changes of the shipped kernels, and the share that a check notices. `docs/mutation.md` says how
//! to use it.

mod bench;
mod change;
mod journal;
mod limits;
mod measure;
mod options;
mod subject;
mod table;
mod verdict;

use std::process::ExitCode;
use std::time::{Duration, Instant};

use bench::Bench;
use clap::Parser;
use journal::Journal;
use options::Options;
use subject::Subject;
use suite::Error;
use verdict::find_verdicts;

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
    let minutes = options
        .minutes
        .map(|minutes| Duration::from_secs(60 * minutes));
    let deadline = minutes.map(|time| Instant::now() + time);
    let due = || deadline.is_none_or(|deadline| Instant::now() < deadline);
    let subjects = (options.filters.iter())
        .map(|filter| Subject::new(filter, options.count))
        .collect::<Result<Vec<_>, _>>()?;
    let mut bench = Bench::open(options, &subjects)?;
    let mut journal = Journal::open(&bench.out)?;
    for subject in &subjects {
        change::measure_changes(&mut bench, subject, &mut journal, &due)?;
    }
    let mut limits = Vec::new();
    for subject in &subjects {
        limits.push(limits::find_limits(&bench, subject, &mut journal)?);
    }
    for (subject, limits) in subjects.iter().zip(&limits) {
        measure::measure_mutants(&mut bench, subject, limits, &mut journal, &due)?;
    }
    let mut all = Vec::new();
    for (subject, limits) in subjects.iter().zip(&mut limits) {
        limits::widen_limits(&bench, subject, limits, &mut journal, &due)?;
        let verdicts = find_verdicts(&bench, subject, limits, &journal);
        let table = table::format_subject(&bench, subject, limits, &verdicts);
        print!("{table}");
        all.extend(verdicts);
    }
    if subjects.len() > 1 {
        print!("{}", table::format_total(&all));
    }
    Ok(())
}
