//! The command `run`.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use judge::{Level, judge};
use store::printable_path;
use suite::{Error, Part, Run, open_gpu, refuse_failures};

use super::measured_run::{MeasuredRun, measure};
use super::pages::{WrittenFile, page_lines, page_path, refuse_folder, write_run_page};
use super::run_files::{write_judged_run, write_run};
use super::run_plan::{apply_options, make_plan, read_case_bounds};
use crate::arguments::{AdapterArgs, MeasureArgs, RunOptions, parse_named};
use crate::output::{clock_text, print};
use crate::tables::{
    adapter_text, failures_text, legend_text, ranking_text, run_table, sequences_text,
};

#[derive(Debug, Args)]
pub struct RunArgs {
    #[command(flatten)]
    pub measure: MeasureArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    #[command(flatten)]
    pub options: RunOptions,
    /// Measure a part of a run that `truths merge` joins with others. Writes run.json and pictures, but no report.
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

/// Runs every case, writes `run.json` and the page, prints the ranking or the table.
pub fn execute(args: &RunArgs) -> Result<(), Error> {
    let began = Instant::now();
    refuse_folder("--html", args.html.as_ref())?;
    let (mut plan, mut bounds) = make_plan(&args.measure, args.measure.scenes.out.clone())?;
    apply_options(&mut plan, &args.options)?;
    plan.part = args.part.unwrap_or_default();
    let size = (plan.render.width, plan.render.height);
    for bounds in bounds.values_mut() {
        *bounds = std::mem::take(bounds).at(size).over(plan.frames);
    }
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref(), plan.monitor)?;
    let MeasuredRun {
        run,
        whole,
        claim: _claim,
    } = measure(&mut plan, gpu.as_ref())?;
    if plan.part != Part::Whole {
        let json = write_run(&whole, &plan.out)?;
        print(&match args.json {
            true => format!("{json}\n"),
            false => {
                failures_text(&run.failures) + &closing_text(&run, &[], &plan.out, began.elapsed())
            }
        })?;
        return refuse_failures(&run.failures);
    }
    // Cases of an earlier run keep their targets.
    let root = &args.measure.scenes.root.scenes_dir;
    for case in &whole.cases {
        if !bounds.contains_key(&case.scene)
            && let Some(earlier) = read_case_bounds(root, case, size)?
        {
            bounds.insert(case.scene.clone(), earlier.over(plan.frames));
        }
    }
    // Bounds are the business of `check`: those that a run breaks fail nothing.
    let mut findings = judge(&whole, &bounds);
    for finding in &mut findings {
        finding.level = Level::Report;
    }
    let json = write_judged_run(&whole, &findings, &plan.out)?;
    let html = page_path(args.html.as_ref(), &plan.out);
    let pages = write_run_page(&whole, &findings, &plan.out, &html)?;
    if args.json {
        print(&format!("{json}\n"))?;
    } else {
        let scores = match args.table {
            true => run_table(&run),
            false => ranking_text(&run.cases),
        };
        let scaling = run.scaling_note();
        let scaling = scaling.map_or(String::new(), |note| legend_text(&note));
        let text =
            scores + &scaling + &sequences_text(&run, args.table) + &failures_text(&run.failures);
        print(&(text + &closing_text(&run, &pages, &plan.out, began.elapsed())))?;
    }
    refuse_failures(&run.failures)
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
