//! A fuzzer: hostile and broken input for everything that the program reads. `docs/fuzzing.md` says how to use it.

mod batch;
mod campaign;
mod failure;
mod fixture;
mod huge;
mod mutation;
mod options;
mod place;
mod random;
mod seeds;
mod self_test;
mod target;
mod targets;
mod tokens;
mod worker;

use std::process::ExitCode;

use options::Options;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match Options::parse(&words) {
        Err(reason) => {
            eprintln!("fuzz: {reason}");
            ExitCode::from(2)
        }
        Ok(Options::Nothing) => ExitCode::SUCCESS,
        Ok(Options::Work(work)) => worker::work(&work),
        Ok(Options::Try(input)) => campaign::try_one(&input),
        Ok(Options::Campaign(plan)) => campaign::execute(&plan),
    }
}
