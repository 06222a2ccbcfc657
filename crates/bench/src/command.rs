//! The command `bench`.

use std::path::PathBuf;
use terminal::refuse;

use clap::Args;
use filters::Gpu;
use frame::Size;
use measure::{Error, open_adapter};

use terminal::arguments::{AdapterArgs, parse_size, within};
use terminal::expected::print_expected_time;
use terminal::output::make_monitor;
use terminal::result::{write_json, write_result};
use terminal::selection::{Programs, select_filters};
use terminal::table::TableArgs;

use crate::page::BENCH_FILE;
use crate::table::{bench_csv, bench_markdown};
use crate::{BenchPlan, bench, bench_table};

/// Arguments of `bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Filters: names, folders or patterns such as 'jump*', each with an optional :preset;
    /// repeatable, or separated by commas [default: all built-in ones]. Times are relative to
    /// jump_flood:paper, which is timed as well.
    #[arg(
        long = "filter",
        visible_alias = "filters",
        value_delimiter = ',',
        value_name = "FILTERS"
    )]
    pub filters: Vec<String>,
    /// Picture size in pixels [default: 1920x1080, or 320x180 on a software adapter].
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<Size>,
    /// Times that each filter runs, in turns with the others; 20 or more.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = within::<u32>(20..=10_000))]
    pub rounds: u32,
    /// Keep lengths in pixels as the preset has them [default: scale them from the width that the
    /// preset was made for to the picture's].
    #[arg(long)]
    pub as_written: bool,
    /// Adapter to time.
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Folder for bench.json.
    #[arg(
        help_heading = "Output",
        short,
        long,
        value_name = "DIR",
        default_value = "out"
    )]
    pub out: PathBuf,
    /// Print bench.json to standard output instead of the tables.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
    /// Other forms of the table.
    #[command(flatten)]
    pub tables: TableArgs,
}

/// Time that llvmpipe on two cores needs to filter a pixel, in seconds: the built-in filters' mean
/// at 320x180.
const SECONDS_PER_PIXEL: f64 = 1.4e-6;

/// Times the selected filters, writes `bench.json`, prints the tables.
pub fn execute(args: &BenchArgs) -> Result<(), Error> {
    // Programs are refused below, for another reason.
    let filters = select_filters(&args.filters, None, &[], Programs::Allowed)?;
    if let Some(choice) = filters
        .iter()
        .find(|choice| choice.filter.command.is_some())
    {
        refuse!(
            "filter {} is a program, which has no passes to time; leave it out of --filter",
            choice.filter.name
        );
    }
    let gpu = open_adapter(args.adapter.adapter.as_deref(), make_monitor())?;
    let Size { width, height } = args.size.unwrap_or(match gpu.adapter.kind.as_str() {
        "software" => Size::new(320, 180),
        _ => Size::new(1920, 1080),
    });
    let plan = BenchPlan {
        filters,
        width,
        height,
        rounds: args.rounds,
        as_written: args.as_written,
    };
    print_expected_bench(&plan, &gpu);
    let done = make_monitor().watch("bench", |watch| bench(plan, &gpu, watch))?;
    let path = args.out.join(BENCH_FILE);
    let markdown = || bench_markdown(&done);
    if args.tables.write(|| bench_csv(&done), markdown)? {
        return write_json(&path, &done).map(drop);
    }
    write_result(&path, &done, bench_table(&done), args.json)
}

/// Prints the expected time of a bench. It is short on a graphics card.
fn print_expected_bench(plan: &BenchPlan, gpu: &Gpu) {
    if gpu.adapter.kind == "software" {
        let pixels = plan.count_runs() * u64::from(plan.width) * u64::from(plan.height);
        let runs = format!(
            "{} runs of {} filters",
            plan.count_runs(),
            plan.filters.len()
        );
        print_expected_time(pixels as f64 * SECONDS_PER_PIXEL, &runs);
    }
}
