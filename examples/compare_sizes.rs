//! Prints, as Markdown, how the ranking of filters changes with the picture size: `cargo run -p shuttertruth
//! --example compare_sizes -- out/160x90/run.json out/320x180/run.json
//! results/1280x720_llvmpipe.json`.

use std::path::Path;
use std::process::ExitCode;

use judge::{Agreement, FilterAtSizes, Results, SizeComparison, compare_sizes};
use measure::{Error, Run, escape_markdown, markdown_code};
use metrics::Metric;

fn main() -> ExitCode {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    if paths.is_empty() {
        eprintln!(
            "nothing given; name a run.json or a file of results per size, of the same scenes and filters"
        );
        return ExitCode::from(2);
    }
    match print_tables(&paths) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn print_tables(paths: &[String]) -> Result<(), Error> {
    let results: Vec<Results> = (paths.iter())
        .map(|path| read(Path::new(path)))
        .collect::<Result<_, _>>()?;
    let mut results: Vec<&Results> = results.iter().collect();
    results.sort_by_key(|results| results.size.pixels());
    for metric in [Metric::FLIP, Metric::LABEL] {
        for comparison in compare_sizes(&results, metric)? {
            println!(
                "## {}, {} shutter\n\nMean over {}, and place.\n",
                metric.name(),
                comparison.alignment,
                comparison
                    .scenes
                    .iter()
                    .map(|scene| escape_markdown(&scene.to_string()))
                    .collect::<Vec<_>>()
                    .join(", ")
            );
            print_means(&comparison, metric);
            print_agreement(&comparison);
            print_reversals(&comparison);
        }
    }
    Ok(())
}

/// Reads a run.json, or a file of results.
fn read(path: &Path) -> Result<Results, Error> {
    if path.ends_with("run.json") {
        Results::from_runs(&[Run::read(path)?])
    } else {
        Results::read(path)
    }
}

fn print_means(comparison: &SizeComparison, metric: Metric) {
    println!("| filter |{}", size_columns(comparison));
    println!("| --- |{}", " --- |".repeat(comparison.sizes.len()));
    for FilterAtSizes { name, means, ranks } in &comparison.filters {
        let cells = means.iter().zip(ranks).map(|(mean, rank)| {
            let [low, high] = mean.interval.map(|end| metric.number(end));
            format!(" {} ({low} to {high}), {rank} |", metric.number(mean.mean))
        });
        println!("| {} |{}", markdown_code(name), cells.collect::<String>());
    }
    println!();
}

fn print_agreement(comparison: &SizeComparison) {
    let row = |what: &str, cell: &dyn Fn(&Agreement) -> String| {
        let cells =
            (comparison.agreement.iter()).map(|agreement| format!(" {} |", cell(agreement)));
        println!("| {what} |{}", cells.collect::<String>());
    };
    println!("| against the largest size |{}", size_columns(comparison));
    println!("| --- |{}", " --- |".repeat(comparison.sizes.len()));
    row(
        "Kendall's tau (95 % CI)",
        &|agreement| match agreement.interval {
            Some([low, high]) => format!("{:.2} ({low:.2} to {high:.2})", agreement.tau),
            None => format!("{:.2}", agreement.tau),
        },
    );
    row("pairs ordered by both, alike", &|agreement| {
        agreement.alike.to_string()
    });
    row("pairs ordered by both, **reversed**", &|agreement| {
        agreement.reversed.len().to_string()
    });
    row("pairs ordered only here", &|agreement| {
        agreement.only_here.to_string()
    });
    row("pairs ordered only at the largest", &|agreement| {
        agreement.only_at_largest.to_string()
    });
    println!();
}

fn print_reversals(comparison: &SizeComparison) {
    for (size, agreement) in comparison.sizes.iter().zip(&comparison.agreement) {
        for reversal in &agreement.reversed {
            println!(
                "- {size} says that {} is better than {} by {:.3}; the largest size says that it is worse by {:.3}.",
                markdown_code(&reversal.better_here),
                markdown_code(&reversal.better_at_largest),
                reversal.differences[0],
                -reversal.differences[1]
            );
        }
    }
    println!();
}

/// ` 160x90 | 320x180 |`
fn size_columns(comparison: &SizeComparison) -> String {
    (comparison.sizes.iter())
        .map(|size| format!(" {size} |"))
        .collect()
}
