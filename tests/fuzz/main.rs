//! A fuzzer: hostile and broken input for everything that the program reads. `docs/fuzzing.md` explains how to use it.

mod campaign;
mod dictionary;
mod fixture;
mod mutation;
mod options;
mod place;
mod seeds;
mod self_test;
mod target;
mod targets;
mod worker_process;

use std::process::ExitCode;

use clap::Parser;
use options::Options;

fn main() -> ExitCode {
    let options = Options::parse();
    match options.work[..] {
        _ if options.asks_for_other_tests() => ExitCode::SUCCESS,
        [start, end] => worker_process::work(&options, start..end),
        _ => campaign::execute(options),
    }
}
