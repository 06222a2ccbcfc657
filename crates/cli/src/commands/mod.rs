//! One file per command, and the work that commands share.

mod accept;
mod ask;
mod audit;
mod bench;
mod blur;
mod calibrate;
mod candidate;
mod capture;
mod check;
mod compare;
mod compare_presets;
mod completions;
mod convention;
mod ending;
mod evaluate;
mod expected;
mod export;
mod import;
mod ingest;
mod kept_truths;
mod list;
mod man;
mod margins;
mod measured_run;
mod merge;
mod pack;
mod pages;
mod plan;
mod preferences;
mod render;
mod render_settings;
mod report;
mod result;
mod run;
mod run_files;
mod run_plan;
mod score;
mod score_sequence;
mod sensitivity;
mod serve;
mod threads;
mod try_filters;
mod tune;
mod verify;

pub use self::ending::Ending;
use self::threads::work_on_threads;
use crate::arguments::{Cli, Command};
use suite::Error;

/// Executes the command.
pub fn execute(cli: Cli) -> Result<Ending, Error> {
    if cli.list_adapters {
        return list::print_adapters().map(|()| Ending::Done);
    }
    let done = match cli.command {
        Some(Command::Run(args)) => {
            work_on_threads(args.measure.scenes.threads, || run::execute(&args))
        }
        Some(Command::Check(args)) => {
            return work_on_threads(args.measure.scenes.threads, || check::execute(&args));
        }
        Some(Command::Accept(args)) => accept::execute(&args),
        Some(Command::Calibrate(args)) => {
            work_on_threads(args.measure.scenes.threads, || calibrate::execute(&args))
        }
        Some(Command::Render(args)) => {
            work_on_threads(args.scenes.threads, || render::execute(&args))
        }
        Some(Command::Plan(args)) => plan::execute(&args),
        Some(Command::Merge(args)) => merge::execute(&args),
        Some(Command::Pack(args)) => pack::execute(&args),
        Some(Command::Verify(args)) => {
            return work_on_threads(args.threads, || verify::execute(&args));
        }
        Some(Command::Blur(args)) => blur::execute(&args),
        Some(Command::Score(args)) => score::execute(&args),
        Some(Command::Report(args)) => report::execute(&args),
        Some(Command::Compare(args)) => compare::execute(&args),
        Some(Command::Ask(args)) => ask::execute(&args),
        Some(Command::Preferences(args)) => preferences::execute(&args),
        Some(Command::Bench(args)) => bench::execute(&args),
        Some(Command::Tune(args)) => {
            work_on_threads(args.candidate.scenes.threads, || tune::execute(&args))
        }
        Some(Command::Sensitivity(args)) => work_on_threads(args.candidate.scenes.threads, || {
            sensitivity::execute(&args)
        }),
        Some(Command::ComparePresets(args)) => {
            work_on_threads(args.candidate.scenes.threads, || {
                compare_presets::execute(&args)
            })
        }
        Some(Command::Evaluate(args)) => {
            work_on_threads(args.candidate.scenes.threads, || evaluate::execute(&args))
        }
        Some(Command::Serve(args)) => {
            work_on_threads(args.candidate.scenes.threads, || serve::execute(&args))
        }
        Some(Command::Import(args)) => import::execute(&args),
        Some(Command::Export(args)) => export::execute(&args),
        Some(Command::Audit(args)) => return audit::execute(&args),
        Some(Command::Ingest(args)) => ingest::execute(&args),
        Some(Command::List(args)) => list::execute(&args),
        Some(Command::Completions(args)) => completions::execute(&args),
        Some(Command::Man(args)) => man::execute(&args),
        None => Err(Error::Usage(
            "no command given; shuttertruth --help lists all commands".to_owned(),
        )),
    };
    done.map(|()| Ending::Done)
}
