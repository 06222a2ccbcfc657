//! The command `run`.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use measure::{Error, Part, Run, open_gpu, printable_path, refuse_failures};
use report::AddToPage;

use crate::measured::{MeasuredRun, measure};
use crate::pages::{WrittenFile, page_lines, refuse_folder, write_judgement, write_run};
use crate::plan::{apply_options, make_plan};
use crate::tables::{
    TableArgs, cases_csv, cases_markdown, failures_text, legend_text, ranking_markdown,
    ranking_text, run_table, sequences_text, smears_text,
};
use crate::watch::{finished_text, repeat_on_change};
use terminal::arguments::{AdapterArgs, MeasureArgs, RunOptions, parse_named};
use terminal::output::{Text, adapter_text, clock_text, open_page, print, print_above_bars};
use terminal::refuse;
use terminal::selection::filter_folders;

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
    /// Open the page in the browser.
    #[arg(help_heading = "Output", long, conflicts_with = "part")]
    pub open: bool,
    /// Run again whenever a file in a filter's folder changes; Ctrl-C ends.
    #[arg(help_heading = "Output", long, conflicts_with = "part")]
    pub watch: bool,
    /// Print every case and all means, instead of the ranking.
    #[arg(help_heading = "Output", long, conflicts_with = "json")]
    pub table: bool,
    /// Print run.json to standard output instead of the ranking.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
    /// Other forms of the ranking or the table.
    #[command(flatten)]
    pub tables: TableArgs,
}

/// Runs every case, writes `run.json` and the page, and prints the ranking or the table; with
/// --watch, again after each change. `additions` make what other crates add to the page.
pub fn execute(args: &RunArgs, additions: &[AddToPage]) -> Result<(), Error> {
    if !args.watch {
        return run_once(args, additions, args.open);
    }
    let folders = filter_folders(&args.measure.filters);
    if folders.is_empty() {
        refuse!(
            "--watch: no filter of the run is a folder; name one with --filter, such as ./my_blur"
        );
    }
    let mut open = args.open;
    repeat_on_change(&folders, || {
        // Later pages replace the open one.
        run_once(args, additions, std::mem::take(&mut open))
    })
}

fn run_once(args: &RunArgs, additions: &[AddToPage], open: bool) -> Result<(), Error> {
    let began = Instant::now();
    refuse_folder("--html", args.html.as_ref())?;
    let (mut plan, _) = make_plan(&args.measure, args.measure.scenes.out.clone())?;
    apply_options(&mut plan, &args.options)?;
    plan.part = args.part.unwrap_or_default();
    if args.watch {
        plan.finished = |cases| print_above_bars(&finished_text(cases));
    }
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref(), plan.monitor)?;
    let MeasuredRun {
        run,
        whole,
        lock: _lock,
    } = measure(&mut plan, gpu.as_ref())?;
    write_run(&whole, &plan.out)?;
    let markdown = || {
        if args.table {
            cases_markdown(&run)
        } else {
            ranking_markdown(&run.cases)
        }
    };
    let is_printed = args.tables.write(|| cases_csv(&run), markdown)?;
    let (scores, pages) = if plan.part == Part::Whole {
        // Bounds are for `check`. A judgement without findings replaces that of an earlier check.
        let html = args.html.as_ref();
        let pages = write_judgement(&whole, &[], None, &plan.out, html, additions)?;
        (scores_text(&run, args), pages)
    } else {
        (Text::default(), Vec::new())
    };
    if let Some(page) = pages.first().filter(|_| open) {
        open_page(&page.path);
    }
    print(if args.json {
        Text::from(whole.text()) + "\n"
    } else if is_printed {
        Text::default()
    } else {
        scores
            + failures_text(&run.failures)
            + closing_text(&run, &pages, &plan.out, began.elapsed())
    })?;
    refuse_failures(&run.failures)
}

/// Formats the ranking or the table, and its subject.
fn scores_text(run: &Run, args: &RunArgs) -> Text {
    let scores = if args.table {
        run_table(run)
    } else {
        ranking_text(run)
    };
    let scaling = run.scaling_note();
    let scaling = scaling.map_or(Text::default(), |note| legend_text(&note));
    // Nobody asked about the lengths of all built-in filters.
    let smears = if args.measure.filters.is_empty() {
        Text::default()
    } else {
        smears_text(&run.cases)
    };
    scores + scaling + sequences_text(run, args.table) + smears
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
