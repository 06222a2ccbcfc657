//! Pages of a run, a comparison and a tuning, each of which opens from disk and fetches nothing.

mod case;
mod charts;
mod comparison;
mod document;
mod filter_id;
mod filter_page;
mod finding_text;
mod gallery;
mod numbers;
mod overview;
mod pixels;
mod run_facts;
mod run_page;
mod sequence;
mod tuning;

use std::path::Path;

use suite::Finding;
use suite::{Case, Error, Run};

use case::case_section;
use case::case_view::{CaseInput, CaseView};
use filter_id::{list_filters, list_scenes};
use filter_page::filter_section;
use overview::costs::read_bench;
use overview::overview;
use pixels::report_files::SceneNumbers;
use pixels::scene_files::SceneFiles;
use run_page::run_page;

pub use comparison::{ChangeCells, compare_page};
pub use finding_text::{finding_line, finding_score, finding_status, way_out};
pub use gallery::write_gallery;
pub use pixels::report_files::{LARGEST_PAGE, Report};
pub use sequence::{SEQUENCES_PAGE, sequences_page};
pub use tuning::{TuneFolder, tuning_page};

/// Makes the page of a run whose files lie below `folder`, that of its run.json, to be written to `html`.
///
/// A bench.json that lies there too says what the filters cost. `findings` are those about the run; without any the page shows no
/// bounds. If the page would have more than `largest` bytes, [`LARGEST_PAGE`] for instance, its numbers lie beside it. Reads files
/// and writes none; the same run makes the same bytes.
pub fn report(
    run: &Run,
    findings: &[Finding],
    folder: &Path,
    html: &Path,
    largest: usize,
) -> Result<Report, Error> {
    refuse_empty(run)?;
    let bench = read_bench(folder)?;
    let mut texts = Vec::new();
    let mut views = Vec::new();
    let mut thumbnails = Vec::new();
    for (scene, name) in list_scenes(run).into_iter().enumerate() {
        let own = || {
            let all = run.cases.iter().enumerate();
            all.filter(|(_, case)| case.scene == name)
        };
        let cases: Vec<&Case> = own().map(|(_, case)| case).collect();
        let mut files = SceneFiles::read(run, &cases, folder)?;
        for (index, case) in own() {
            let about = |finding: &&Finding| !case.is_reference && finding.is_of(case);
            let input = CaseInput {
                run,
                index,
                findings: findings.iter().filter(about).cloned().collect(),
                scene,
            };
            views.push(CaseView::read(input, folder, &mut files)?);
        }
        texts.push(files.planes.json());
        thumbnails.push(files.thumbnail()?);
    }
    views.sort_by_key(|view| view.index);
    let filters = list_filters(run).into_iter();
    let filters = filters.filter(|filter| !filter.is_reference);
    let sections: Vec<_> = (views.iter().map(case_section))
        .chain(filters.map(|filter| filter_section(run, &filter, &thumbnails, bench.as_ref())))
        .collect();
    let first = overview(run, &views, &thumbnails, bench.as_ref());
    let text = sections
        .iter()
        .map(|section| section.0.len())
        .sum::<usize>()
        + first.0.len();
    let numbers = SceneNumbers::new(texts, text, html, largest);
    Ok(Report {
        html: html.to_owned(),
        page: run_page(
            run,
            &first,
            &sections,
            &numbers,
            html.parent() == Some(folder),
        ),
        siblings: numbers.siblings(html),
    })
}

/// Refuses what no run of this program holds.
fn refuse_empty(run: &Run) -> Result<(), Error> {
    if run.cases.is_empty() {
        return Err(Error::Usage(
            "the run has no cases, and there is nothing to report; run some scenes and filters"
                .to_owned(),
        ));
    }
    Ok(())
}
