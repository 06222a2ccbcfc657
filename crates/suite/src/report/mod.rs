//! A finished run as one page that opens from disk: nothing in it is fetched from anywhere.

mod case_page;
mod cell;
mod gallery;
mod interval_chart;
mod layer;
pub(crate) mod meaning;
mod overview;
mod page;
mod provenance;
mod ranking;
mod score_rows;
pub(crate) mod shell;
mod shown;
mod subject;
mod tuning;
mod verdicts;
mod viewer;

use std::path::Path;
use std::str::FromStr;

use metrics::Metric;

use crate::gate::findings;
use crate::{Error, Run};

use case_page::{Page, case_page};
use gallery::Gallery;
use overview::overview;
use page::page;

pub use tuning::{TuneFolder, tuning_page};

/// The page of a run whose pictures lie below `folder`, that of its run.json. Reads pictures and writes nothing; the same
/// run makes the same bytes.
pub fn report(run: &Run, folder: &Path) -> Result<String, Error> {
    check(run)?;
    let mut gallery = Gallery::default();
    let mut findings = findings(run).into_iter();
    let mut pages = Vec::new();
    for (index, case) in run.cases.iter().enumerate() {
        let own: Vec<_> = findings.by_ref().take(case.verdicts.len()).collect();
        let page = Page::read(run, index, own, folder, &mut gallery)?;
        pages.push(page);
    }
    let cases: Vec<_> = pages.iter().map(case_page).collect();
    let page = page(run, &overview(run, &pages), &cases, &gallery);
    Ok(page.into_string())
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
