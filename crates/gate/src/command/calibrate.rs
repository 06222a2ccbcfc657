//! The command `limits calibrate`.

use std::ops::Range;
use terminal::refuse;

use crate::calibrate::calibrate;
use clap::Args;
use judge::{BOUNDS_FILE, bound_subframes, check_names};
use measure::{
    Error, Run, RunPlan, estimate_run, measure_scenes, open_gpu, printable_path, refuse_failures,
};
use metrics::Metric;
use tracer::{Progress, Watch};

use run::write_run;
use run::{choose_samples, lock_out, make_plan};
use terminal::arguments::{MeasureArgs, SequenceArgs, within};
use terminal::expected::print_expected_time;
use terminal::output::print;

/// Arguments of `limits calibrate`.
#[derive(Debug, Args)]
pub struct CalibrateArgs {
    /// What to measure.
    #[command(flatten)]
    pub measure: MeasureArgs,
    /// Frames of each scene.
    #[command(flatten)]
    pub sequence: SequenceArgs,
    /// Number of runs, each with a truth of its own seed: --seed, --seed + 1, and so on.
    #[arg(help_heading = "Calibration", long, value_name = "K", default_value_t = 3, value_parser = within::<u32>(2..=100))]
    pub runs: u32,
    /// Adapters, by their numbers in `list adapters` or parts of their names, separated by commas
    /// [default: the fastest].
    #[arg(
        help_heading = "Calibration",
        long,
        value_delimiter = ',',
        value_name = "ADAPTERS"
    )]
    pub adapters: Vec<String>,
    /// Metrics to propose bounds for, separated by commas [default: those that have bounds, and
    /// deficit, gather_spread, label_tv_p95 and static_contamination; with --frames all metrics of
    /// sequences too].
    #[arg(help_heading = "Calibration", long, value_delimiter = ',', value_name = "METRICS", value_parser = Metric::parse_bounded)]
    pub metrics: Vec<Metric>,
}

/// Runs once per seed and adapter, and prints the resulting limits as one bounds.toml per scene.
pub fn execute(args: &CalibrateArgs) -> Result<(), Error> {
    let out = &args.measure.scenes.out;
    let (mut plan, bounds) = make_plan(&args.measure, out.clone())?;
    if let Some(scene) = plan.ingested.first() {
        refuse!(
            "{} was drawn by an engine, and does not change from run to run; write its bounds by hand into {}",
            scene.id,
            scene.folder.join(BOUNDS_FILE).display()
        );
    }
    refuse_single_frames(args)?;
    plan.frames = args.sequence.frames();
    plan.intervals = true;
    plan.check()?;
    // Filter noise has no limit of its own.
    plan.jitter_frames = 0;
    plan.ladders = match args.metrics.as_slice() {
        [] => bound_subframes(bounds.values(), &plan.filters),
        metrics => (metrics.iter()).any(|metric| matches!(metric, Metric::Equivalent(_))),
    };
    check_names(
        &args.measure.scenes.root.scenes_dir,
        bounds.values(),
        &plan.filters,
    )?;
    list_seeds(plan.render.seed, args.runs)?;
    let _lock = lock_out(&plan)?;
    let adapters: Vec<Option<&str>> = match args.adapters.as_slice() {
        // The fastest.
        [] => vec![None],
        named => named.iter().map(|name| Some(name.as_str())).collect(),
    };
    let count = adapters.len() * args.runs as usize;
    // Assumes that nothing is cached.
    let one = estimate_run(&plan, None);
    print_expected_time(
        one.seconds * count as f64,
        &format!("{count} runs of {} cases", one.cases),
    );
    let monitor = plan.monitor;
    let runs = monitor.watch("runs in all", |watch| {
        run_all(args, &mut plan, &adapters, watch)
    })?;
    let calibration = calibrate(&runs, |case| &bounds[&case.scene], &args.metrics);
    for scene in calibration.scenes() {
        let path = out.join(format!("{scene}.bounds.toml"));
        let text = calibration.toml(scene);
        frame::write_atomically(&path, text.as_bytes())?;
        print(format!("# {}\n\n{text}", printable_path(&path)))?;
    }
    Ok(())
}

/// Refuses metrics of sequences if single frames are measured.
fn refuse_single_frames(args: &CalibrateArgs) -> Result<(), Error> {
    let is_of_sequence = |metric: &&Metric| matches!(metric, Metric::Sequence(_));
    match args.metrics.iter().find(is_of_sequence) {
        Some(metric) if args.sequence.frames().is_one() => refuse!(
            "--metrics: {metric} is a score of a sequence, and single frames would be measured; say of how many frames with \
             --frames"
        ),
        _ => Ok(()),
    }
}

/// Lists the seeds of a calibration's runs. Refuses a first seed so large that the last run would
/// have none.
pub fn list_seeds(first: u64, runs: u32) -> Result<Range<u64>, Error> {
    match first.checked_add(u64::from(runs)) {
        Some(end) => Ok(first..end),
        None => refuse!(
            "--seed {first}: each of the {runs} runs has the next one; allowed: up to {}",
            u64::MAX - u64::from(runs)
        ),
    }
}

/// Runs once per adapter and seed.
fn run_all(
    args: &CalibrateArgs,
    plan: &mut RunPlan,
    adapters: &[Option<&str>],
    watch: Watch,
) -> Result<Vec<Run>, Error> {
    let total = adapters.len() as u64 * u64::from(args.runs);
    let seeds = list_seeds(plan.render.seed, args.runs)?;
    let mut runs: Vec<Run> = Vec::new();
    choose_samples(plan)?;
    for adapter in adapters {
        let gpu = open_gpu(&plan.filters, *adapter, plan.monitor)?;
        for seed in seeds.clone() {
            // An interrupted run reports that itself.
            let _ = watch(Progress {
                done: runs.len() as u64,
                total,
            });
            plan.render.seed = seed;
            // All adapters share the truths.
            plan.out = args.measure.scenes.out.join(format!("seed_{seed}"));
            let _lock = lock_out(plan)?;
            let finished = measure_scenes(plan, gpu.as_ref(), std::env::args().collect())?;
            write_run(&finished, &plan.out)?;
            refuse_failures(&finished.failures)?;
            runs.push(finished);
        }
    }
    Ok(runs)
}
