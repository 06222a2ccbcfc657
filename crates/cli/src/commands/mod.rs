//! One file per command.

mod accept;
mod bench;
mod blur;
mod calibrate;
mod check;
mod compare;
mod evaluate;
mod import;
mod lines;
mod list;
mod measure;
mod merge;
mod render;
mod report;
mod run;
mod score;
mod serve;
mod tune;

use std::collections::BTreeSet;
use std::io::{ErrorKind, Write};

use crate::output::progress::tell;
use clap::CommandFactory;
use suite::{Error, MOST_REPLICATES, RenderSettings, printable, printable_table};
use tracer::{MOST_SAMPLES, Scene};

use crate::arguments::{Cli, Command, SceneArgs, Switch};

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
        Some(Command::Import(args)) => import::execute(&args),
        Some(Command::List(args)) => list::execute(&args),
        None => Err(Error::Usage(format!(
            "no command given; allowed: {} (see --help)",
            command_names().join(", ")
        ))),
    }
}

/// The words of all commands, in the order of the help.
fn command_names() -> Vec<String> {
    let program = Cli::command();
    let names = program
        .get_subcommands()
        .map(|command| command.get_name().to_owned());
    names.collect()
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

/// Threads that one command may have.
pub const MOST_THREADS: usize = 1024;

/// Tells on standard error what scenes hold that is left out, each once.
fn tell_notes<'a>(scenes: impl IntoIterator<Item = &'a Scene>) {
    let notes: BTreeSet<&String> = scenes.into_iter().flat_map(|scene| &scene.notes).collect();
    for note in notes {
        tell(&format!("shuttertruth: note: {}", printable(note)));
    }
}

fn with_threads(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<(), Error> + Send,
) -> Result<(), Error> {
    if let Some(threads) = threads
        && !(1..=MOST_THREADS).contains(&threads)
    {
        return Err(Error::Usage(format!(
            "--threads {threads}: allowed is 1 to {MOST_THREADS}"
        )));
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
    // A frame has as many samples as all replicates of a truth.
    let most = MOST_SAMPLES / replicates;
    let each = samples_per_pixel / replicates;
    if each.is_power_of_two() && each <= most && each * replicates == samples_per_pixel {
        return Ok(());
    }
    let nearest = each.clamp(1, most).next_power_of_two() * replicates;
    Err(Error::Usage(format!(
        "--samples-per-pixel {samples_per_pixel}: allowed is {replicates} times a power of two, up to {MOST_SAMPLES}, such as {nearest}"
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
