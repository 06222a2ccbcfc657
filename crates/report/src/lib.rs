//! A finished run as one page that opens from disk: nothing in it is fetched from anywhere.

mod case_page;
mod catalogue;
mod cell;
mod comparison;
mod costs;
mod evidence;
mod files;
mod finding_text;
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
mod provenance;
mod ranking;
mod reach_chart;
mod scene_files;
mod score_rows;
mod shelf;
mod shell;
mod shown;
mod subject;
mod tuning;
mod verdicts;
mod viewer;

use std::path::Path;

use suite::Finding;
use suite::{Case, Error, Run};

use case_page::{Page, Which, case_page};
use costs::read_bench;
use files::Packed;
use overview::overview;
use page::page;
use scene_files::SceneFiles;
use subject::scenes;

pub use catalogue::catalogue;
pub use comparison::{compare_page, signed};
pub use files::{LARGEST_PAGE, Report};
pub use finding_text::{finding_line, finding_score, finding_status, way_out};
pub use tuning::{TuneFolder, tuning_page};

/// The page of a run whose files lie below `folder`, that of its run.json, to be written to `html`. A bench.json that lies
/// there too says what the filters cost. `findings` are those about the run; without any the page shows no bounds. A page of more than `largest` bytes, [`LARGEST_PAGE`] for instance, keeps halves for
/// floats, and what is too large still lies beside it. Reads files and writes nothing; the same run makes the same bytes.
pub fn report(
    run: &Run,
    findings: &[Finding],
    folder: &Path,
    html: &Path,
    largest: usize,
) -> Result<Report, Error> {
    check(run)?;
    let bench = read_bench(folder)?;
    let mut packed = Packed::new(largest);
    let mut pages = Vec::new();
    for (scene, name) in scenes(run).into_iter().enumerate() {
        let own = || {
            run.cases
                .iter()
                .enumerate()
                .filter(|(_, case)| case.scene == name)
        };
        let cases: Vec<&Case> = own().map(|(_, case)| case).collect();
        let mut files = SceneFiles::read(run, &cases, folder)?;
        for (index, case) in own() {
            let about = |finding: &&Finding| !case.is_reference && finding.is_of(case);
            let which = Which {
                run,
                index,
                findings: findings.iter().filter(about).cloned().collect(),
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
    Ok(())
}
