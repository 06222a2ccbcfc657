//! A finished run as one page that opens from disk: nothing in it is fetched from anywhere.

mod case_page;
mod cell;
mod costs;
mod evidence;
mod files;
mod interval_chart;
mod layer;
mod legend;
mod overview;
mod packing;
mod page;
mod pareto_chart;
mod precision;
mod profile;
mod profile_chart;
pub(crate) mod provenance;
mod ranking;
mod reach_chart;
mod scene_files;
mod score_rows;
mod shelf;
pub(crate) mod shell;
mod shown;
mod subject;
mod tuning;
mod verdicts;
mod viewer;

use std::path::Path;
use std::str::FromStr;

use metrics::Metric;

use crate::gate::{Finding, findings};
use crate::{Case, Error, Run};

use case_page::{Page, Which, case_page};
use costs::read_bench;
use files::Packed;
use overview::overview;
use page::page;
use scene_files::SceneFiles;
use subject::scenes;

pub use files::{LARGEST_PAGE, Report};
pub use tuning::{TuneFolder, tuning_page};

/// The page of a run whose files lie below `folder`, that of its run.json, to be written to `html`. A bench.json that lies
/// there too says what the filters cost. A page of more than `largest` bytes, [`LARGEST_PAGE`] for instance, keeps halves for
/// floats, and what is too large still lies beside it. Reads files and writes nothing; the same run makes the same bytes.
pub fn report(run: &Run, folder: &Path, html: &Path, largest: usize) -> Result<Report, Error> {
    check(run)?;
    let bench = read_bench(folder)?;
    let mut packed = Packed::new(largest);
    let mut pages = Vec::new();
    let mut findings = findings_by_case(run);
    for (scene, name) in scenes(run).into_iter().enumerate() {
        let own = || {
            run.cases
                .iter()
                .enumerate()
                .filter(|(_, case)| case.scene == name)
        };
        let cases: Vec<&Case> = own().map(|(_, case)| case).collect();
        let mut files = SceneFiles::read(run, &cases, folder)?;
        for (index, _) in own() {
            let which = Which {
                run,
                index,
                findings: std::mem::take(&mut findings[index]),
                scene,
            };
            pages.push(Page::read(which, folder, &mut files)?);
        }
        packed.add(&files.shelf);
    }
    pages.sort_by_key(|page| page.index);
    let cases: Vec<_> = pages.iter().map(case_page).collect();
    let overview = overview(run, &pages, bench.as_ref());
    let text: usize = cases.iter().map(|case| case.0.len()).sum::<usize>() + overview.0.len();
    let shelves = packed.shelves(html, text);
    let page = page(run, &overview, &cases, &shelves);
    Ok(Report {
        html: html.to_owned(),
        page: page.into_string(),
        siblings: shelves.siblings(html),
    })
}

/// Refuses what no run of this program holds.
fn check(run: &Run) -> Result<(), Error> {
    if run.cases.is_empty() {
        return Err(Error::Usage(
            "the run has no cases, and there is nothing to report; run some scenes and filters"
                .to_owned(),
        ));
    }
    for case in &run.cases {
        for verdict in &case.verdicts {
            Metric::from_str(&verdict.metric).map_err(|error| {
                Error::Usage(format!(
                    "{} / {}: a verdict's {error}; run it anew with this version",
                    case.scene,
                    case.name()
                ))
            })?;
        }
    }
    Ok(())
}

/// In the order of the run's cases.
fn findings_by_case(run: &Run) -> Vec<Vec<Finding>> {
    let mut findings = findings(run).into_iter();
    let own = |case: &Case| findings.by_ref().take(case.verdicts.len()).collect();
    run.cases.iter().map(own).collect()
}
