//! One file per command.

mod accept;
mod bench;
mod blur;
mod calibrate;
mod catalogue;
mod check;
mod compare;
mod evaluate;
mod import;
mod list;
mod measure;
mod merge;
mod render;
mod report;
mod run;
mod score;
mod serve;
mod tune;

use std::io::{ErrorKind, Write};

use suite::{Error, MOST_REPLICATES, RenderSettings, printable_table};

use tracer::MOST_SAMPLES;

use crate::cli::{Cli, Command, SceneArgs, Switch};

/// Does what the command line says.
pub fn execute(cli: Cli) -> Result<(), Error> {
    if cli.list_adapters {
        return list::adapters();
    }
    match cli.command {
        Some(Command::Run(args)) => {
            with_threads(args.measure.scenes.threads, || run::execute(&args))
        }
        Some(Command::Check(args)) => {
            with_threads(args.measure.scenes.threads, || check::execute(&args))
        }
        Some(Command::Accept(args)) => accept::execute(&args),
        Some(Command::Calibrate(args)) => {
            with_threads(args.measure.scenes.threads, || calibrate::execute(&args))
        }
        Some(Command::Render(args)) => with_threads(args.scenes.threads, || render::execute(&args)),
        Some(Command::Merge(args)) => merge::execute(&args),
        Some(Command::Blur(args)) => blur::execute(&args),
        Some(Command::Score(args)) => score::execute(&args),
        Some(Command::Report(args)) => report::execute(&args),
        Some(Command::Compare(args)) => compare::execute(&args),
        Some(Command::Bench(args)) => bench::execute(&args),
        Some(Command::Tune(args)) => {
            with_threads(args.candidate.scenes.threads, || tune::execute(&args))
        }
        Some(Command::Evaluate(args)) => {
            with_threads(args.candidate.scenes.threads, || evaluate::execute(&args))
        }
        Some(Command::Serve(args)) => {
            with_threads(args.candidate.scenes.threads, || serve::execute(&args))
        }
        Some(Command::Catalogue(args)) => {
            with_threads(args.measure.scenes.threads, || catalogue::execute(&args))
        }
        Some(Command::Import(args)) => import::execute(&args),
        Some(Command::List(args)) => list::execute(&args),
        None => Err(Error::Usage(
            "no command given; allowed: run, check, accept, calibrate, render, merge, blur, score, report, compare, bench, tune, evaluate, serve, catalogue, import, list (see --help)"
                .to_owned(),
        )),
    }
}

/// Prints to standard output, in colours where that is a terminal that shows them; other control characters become escapes. A
/// reader that has read enough, such as `head`, is no error.
fn say(text: &str) -> Result<(), Error> {
    let mut out = anstream::stdout();
    let text = printable_table(text);
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Error::Usage(format!(
            "standard output: cannot write: {error}"
        ))),
        _ => Ok(()),
    }
}

fn with_threads(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<(), Error> + Send,
) -> Result<(), Error> {
    if threads == Some(0) {
        return Err(Error::Usage("--threads 0: allowed is 1 or more".to_owned()));
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .build()
        .map_err(|error| Error::Usage(format!("cannot start the threads: {error}")))?
        .install(work)
}

fn render_settings(
    args: &SceneArgs,
    (width, height): (u32, u32),
    replicates: u32,
) -> Result<RenderSettings, Error> {
    if let Some(exposure) = args.exposure {
        check_exposure(exposure)?;
    }
    check_samples(args.samples_per_pixel)?;
    check_replicates(replicates)?;
    Ok(RenderSettings {
        width,
        height,
        exposure: args.exposure,
        velocity: args.velocity,
        color: args.color,
        sky_velocity: args.sky_velocity == Switch::On,
        guard_band: args.guard_band,
        samples_per_pixel: args.samples_per_pixel,
        seed: args.seed,
        ..RenderSettings::default()
    }
    .with_replicates(replicates))
}

fn check_samples(samples_per_pixel: u32) -> Result<(), Error> {
    let replicates = RenderSettings::default().replicates;
    let each = samples_per_pixel / replicates;
    let allowed = each.is_power_of_two() && each <= MOST_SAMPLES;
    if allowed && each * replicates == samples_per_pixel {
        return Ok(());
    }
    let nearest = each.clamp(1, MOST_SAMPLES).next_power_of_two() * replicates;
    Err(Error::Usage(format!(
        "--samples-per-pixel {samples_per_pixel}: allowed is {replicates} times a power of two, up to {}, such as {nearest}",
        MOST_SAMPLES * replicates
    )))
}

/// Two halves of at least one each, and no more than a truth's files can be numbered by.
fn check_replicates(replicates: u32) -> Result<(), Error> {
    match (2..=MOST_REPLICATES).contains(&replicates) && replicates.is_multiple_of(2) {
        true => Ok(()),
        false => Err(Error::Usage(format!(
            "--replicates {replicates}: allowed are even numbers from 2 to {MOST_REPLICATES}, such as 8"
        ))),
    }
}

fn check_exposure(exposure: f64) -> Result<(), Error> {
    frame::Alignment::Trailing
        .shutter(exposure)
        .map(drop)
        .map_err(|error| Error::Usage(format!("--exposure: {error}")))
}
