//! The command `run`.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use judge::{Level, judge};
use measure::{Error, Part, Run, open_gpu, printable_path, refuse_failures};
use report::AddToPage;

use crate::measured::{MeasuredRun, measure};
use crate::pages::{WrittenFile, page_lines, refuse_folder, write_judgement, write_run};
use crate::plan::{add_bounds, apply_options, make_plan};
use crate::tables::{
    failures_text, legend_text, ranking_text, run_table, sequences_text, smears_text,
};
use terminal::arguments::{AdapterArgs, MeasureArgs, RunOptions, parse_named};
use terminal::output::{Text, adapter_text, clock_text, print};

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// What to measure.
    #[command(flatten)]
    pub measure: MeasureArgs,
    /// Adapter to run kernels on.
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Frames, intervals and the common shutter.
    #[command(flatten)]
    pub options: RunOptions,
    /// Measure a part of a run that `truths merge` joins with others. Writes run.json and pictures,
    /// but no report.
    #[arg(help_heading = "Filters", long, value_name = "PART", value_parser = parse_named(&Part::ALL[1..], Part::name, Part::help), conflicts_with_all = ["html", "table"])]
    pub part: Option<Part>,
    /// HTML page to write [default: report.html in --out].
    #[arg(help_heading = "Output", long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Print every case and all means, instead of the ranking.
    #[arg(help_heading = "Output", long, conflicts_with = "json")]
    pub table: bool,
    /// Print run.json to standard output instead of the ranking.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Runs every case, writes `run.json` and the page, and prints the ranking or the table.
/// `additions` make what other crates add to the page.
pub fn execute(args: &RunArgs, additions: &[AddToPage]) -> Result<(), Error> {
    let began = Instant::now();
    refuse_folder("--html", args.html.as_ref())?;
    let (mut plan, mut bounds) = make_plan(&args.measure, args.measure.scenes.out.clone())?;
    apply_options(&mut plan, &args.options)?;
    plan.part = args.part.unwrap_or_default();
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref(), plan.monitor)?;
    let MeasuredRun {
        run,
        whole,
        lock: _lock,
    } = measure(&mut plan, gpu.as_ref())?;
    write_run(&whole, &plan.out)?;
    let (scores, pages) = if plan.part == Part::Whole {
        // Cases of an earlier run keep their targets.
        add_bounds(&mut bounds, &whole, &args.measure.scenes.root.scenes_dir)?;
        let size = plan.render.size();
        for bounds in bounds.values_mut() {
            *bounds = std::mem::take(bounds).at(size).over(plan.frames);
        }
        // Bounds are for `check`: broken ones fail nothing here.
        let mut findings = judge(&whole, &bounds);
        (findings.iter_mut()).for_each(|finding| finding.level = Level::Report);
        let pages = write_judgement(
            &whole,
            &findings,
            None,
            &plan.out,
            args.html.as_ref(),
            additions,
        )?;
        let mut scores = scores_text(&run, args.table);
        // Nobody asked about the lengths of all built-in filters.
        if !args.measure.filters.is_empty() {
            scores += smears_text(&run.cases);
        }
        (scores, pages)
    } else {
        (Text::default(), Vec::new())
    };
    print(if args.json {
        Text::from(whole.text()) + "\n"
    } else {
        scores
            + failures_text(&run.failures)
            + closing_text(&run, &pages, &plan.out, began.elapsed())
    })?;
    refuse_failures(&run.failures)
}

/// Formats the ranking or the table, and its subject.
fn scores_text(run: &Run, as_table: bool) -> Text {
    let scores = if as_table {
        run_table(run)
    } else {
        ranking_text(&run.cases)
    };
    let scaling = run.scaling_note();
    let scaling = scaling.map_or(Text::default(), |note| legend_text(&note));
    scores + scaling + sequences_text(run, as_table)
}

/// Names the report, run.json and the adapter, and counts cases and time.
fn closing_text(run: &Run, pages: &[WrittenFile], out: &Path, time: Duration) -> String {
    let mut text = "\n".to_owned() + &page_lines("report", pages);
    text += &format!("written: {}\n", printable_path(&out.join("run.json")));
    text += &format!("adapter: {}\n", adapter_text(&run.adapter));
    text += &format!(
        "cases: {}, {} of them read back; took {}\n",
        run.cases.len() + run.failures.len(),
        run.read_back,
        clock_text(time)
    );
    text
}
