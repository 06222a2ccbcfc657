//! One file per command, and the work that commands share.

mod accept;
mod bench;
mod blur;
mod calibrate;
mod candidate;
mod check;
mod compare;
mod evaluate;
mod import;
mod list;
mod merge;
mod pages;
mod plan;
mod render;
mod render_settings;
mod report;
mod run;
mod run_files;
mod score;
mod serve;
mod threads;
mod tune;

use clap::CommandFactory;
use suite::Error;

use self::threads::work_on_threads;
use crate::arguments::{Cli, Command};

/// Executes the command.
pub fn execute(cli: Cli) -> Result<(), Error> {
    if cli.list_adapters {
        return list::print_adapters();
    }
    match cli.command {
        Some(Command::Run(args)) => {
            work_on_threads(args.measure.scenes.threads, || run::execute(&args))
        }
        Some(Command::Check(args)) => {
            work_on_threads(args.measure.scenes.threads, || check::execute(&args))
        }
        Some(Command::Accept(args)) => accept::execute(&args),
        Some(Command::Calibrate(args)) => {
            work_on_threads(args.measure.scenes.threads, || calibrate::execute(&args))
        }
        Some(Command::Render(args)) => {
            work_on_threads(args.scenes.threads, || render::execute(&args))
        }
        Some(Command::Merge(args)) => merge::execute(&args),
        Some(Command::Blur(args)) => blur::execute(&args),
        Some(Command::Score(args)) => score::execute(&args),
        Some(Command::Report(args)) => report::execute(&args),
        Some(Command::Compare(args)) => compare::execute(&args),
        Some(Command::Bench(args)) => bench::execute(&args),
        Some(Command::Tune(args)) => {
            work_on_threads(args.candidate.scenes.threads, || tune::execute(&args))
        }
        Some(Command::Evaluate(args)) => {
            work_on_threads(args.candidate.scenes.threads, || evaluate::execute(&args))
        }
        Some(Command::Serve(args)) => {
            work_on_threads(args.candidate.scenes.threads, || serve::execute(&args))
        }
        Some(Command::Import(args)) => import::execute(&args),
        Some(Command::List(args)) => list::execute(&args),
        None => Err(Error::Usage(format!(
            "no command given; allowed: {} (see --help)",
            command_names().join(", ")
        ))),
    }
}

/// Lists the names of all commands, in the order of the help.
fn command_names() -> Vec<String> {
    let program = Cli::command();
    let names = program
        .get_subcommands()
        .map(|command| command.get_name().to_owned());
    names.collect()
}
