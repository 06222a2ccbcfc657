//! Pages of runs and comparisons, and the building blocks of pages. Each page opens from disk and
//! fetches nothing.

mod addition;
mod address;
mod case;
mod case_table;
pub mod charts;
mod comparison;
pub mod document;
mod filter_page;
mod finding_text;
mod gallery;
mod label;
mod live;
pub mod numbers;
mod overview;
mod picture_page;
mod pixels;
mod run_facts;
mod run_page;
mod run_view;
mod sequence;
pub mod table;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub use addition::{AddToPage, Addition, FilterColumn, FilterNumber, FolderPage};
use case::case_view::CaseView;
use case::{CaseTables, case_section};
pub use case_table::CaseTable;
pub use comparison::{ChangeCells, compare_page};
use filter_page::filter_section;
pub use finding_text::{
    finding_line, finding_score, finding_status, length_text, limit_text, way_out, worst_frame_text,
};
use frame::write_atomically;
pub use gallery::{write_case_strip, write_gallery};
use judge::{Finding, Verdict};
pub use label::label;
use live::scene::scene_json;
use live::{Live, LiveFiles};
use maud::{Markup, PreEscaped};
use measure::{Case, Error, Run};
use overview::overview;
pub use picture_page::{NamedPicture, PicturePage, picture_page};
pub use pixels::report_files::LARGEST_PAGE;
use pixels::report_files::{Place, SceneTexts, write_script};
use pixels::scene_files::SceneFiles;
use rayon::prelude::*;
pub use run_facts::adapter_text;
use run_page::{PageContent, run_page};
use run_view::RunView;
pub use sequence::{SEQUENCES_PAGE, sequences_page};

/// Approximate bytes of the tables of a case.
const CASE_BYTES: usize = 25_000;

/// A run and what its page shows of it.
pub struct RunReport<'a> {
    /// The run.
    pub run: &'a Run,
    /// Folder of the run's files.
    pub folder: &'a Path,
    /// Findings about the run; without any, the page shows no bounds.
    pub findings: &'a [Finding],
    /// Verdict of a check, which the page shows first.
    pub verdict: Option<&'a Verdict>,
    /// Contents of other crates.
    pub additions: &'a [Addition],
    /// Upper limit on the bytes of the page, such as [`LARGEST_PAGE`]. The numbers of a larger page
    /// go into files; if its tables alone are larger, so do they.
    pub largest: usize,
}

/// Writes the page of a run to `html`; returns its path, then the paths of the files next to it.
///
/// Filters and frames of live cases are always in files. The same run makes the same bytes. The
/// page is written last: an existing page is complete.
///
/// # Errors
/// A file of the run is missing or broken, or a file of the report cannot be written.
pub fn write_report(report: &RunReport, html: &Path) -> Result<Vec<PathBuf>, Error> {
    let RunReport { run, folder, .. } = *report;
    if run.cases.is_empty() {
        return Err(Error::Refused(
            "the run has no cases, and there is nothing to report; run some scenes and filters"
                .to_owned(),
        ));
    }
    let table = CaseTable::new(run);
    let shown = table.scenes.iter().flat_map(|scene| table.cases_on(scene));
    let live = LiveFiles::find(run, shown.map(|(_, case)| case), folder);
    let mut parts = Parts::new(run, html, report.largest);
    let scenes: Vec<usize> = (0..table.scenes.len()).collect();
    // As many at once as there are threads: their planes take memory.
    for chunk in scenes.chunks(rayon::current_num_threads()) {
        let read = |scene: &usize| ScenePart::read(*scene, report, &table, &live, parts.has_tables);
        let read: Vec<_> = chunk.par_iter().map(read).collect();
        for scene in read {
            parts.add(scene?)?;
        }
    }
    parts.live.extend(live.write(html)?);
    parts.views.sort_by_key(|view| view.index);
    let view = RunView {
        table: &table,
        cases: &parts.views,
        thumbnails: &parts.thumbnails,
        verdict: report.verdict,
        additions: report.additions,
    };
    let filters = table.filters.iter().filter(|filter| !filter.is_reference);
    let sections: Vec<Markup> = filters
        .map(|filter| filter_section(&view, filter))
        .collect();
    let first = overview(&view);
    parts.sections.extend(sections);
    let text: usize = parts.sections.iter().map(|section| section.0.len()).sum();
    let numbers = parts.numbers.place(text + first.0.len())?;
    let content = PageContent {
        overview: &first,
        sections: &parts.sections,
        numbers: &numbers,
        has_tables: parts.has_tables,
        has_live: !parts.live.is_empty(),
        links_sequences: html.parent() == Some(folder),
    };
    write_atomically(html, run_page(run, &content, html).as_bytes())?;
    let files = [numbers, parts.tables.place(0)?].into_iter();
    let files = files.flat_map(Place::paths).chain(parts.live);
    Ok(std::iter::once(html.to_owned()).chain(files).collect())
}

/// Parts of a page in progress.
struct Parts<'a> {
    /// True if the sections of cases contain their tables, so that the page need not load them.
    has_tables: bool,
    /// Numbers of the pictures.
    numbers: SceneTexts,
    /// Tables that are not in the sections.
    tables: SceneTexts,
    /// Files of live cases.
    live: Vec<PathBuf>,
    /// Sections of the cases, in the order of the run.
    sections: Vec<Markup>,
    views: Vec<CaseView<'a>>,
    /// One per scene.
    thumbnails: Vec<String>,
}

impl<'a> Parts<'a> {
    fn new(run: &Run, html: &Path, largest: usize) -> Self {
        let has_tables = run.cases.len() <= largest / CASE_BYTES;
        Self {
            has_tables,
            numbers: SceneTexts::new("scene", html, if has_tables { largest } else { 0 }),
            tables: SceneTexts::new("tables", html, 0),
            live: Vec::new(),
            sections: vec![PreEscaped(String::new()); run.cases.len()],
            views: Vec::new(),
            thumbnails: Vec::new(),
        }
    }

    fn add(&mut self, scene: ScenePart<'a>) -> Result<(), Error> {
        for (view, section) in scene.views.into_iter().zip(scene.sections) {
            self.sections[view.index] = section;
            self.views.push(view);
        }
        if !self.has_tables {
            let text = serde_json::to_string(&scene.tables).expect("texts are plain data");
            self.tables.add(text)?;
        }
        if let Some(json) = scene.live {
            let name = format!("live_scene_{}", self.thumbnails.len());
            self.live
                .push(write_script(self.numbers.html(), &name, &json)?);
        }
        self.numbers.add(scene.numbers)?;
        self.thumbnails.push(scene.thumbnail);
        Ok(())
    }
}

/// What a page shows of one scene.
struct ScenePart<'a> {
    views: Vec<CaseView<'a>>,
    /// One per view.
    sections: Vec<Markup>,
    /// Tables that are not in the sections, by the names of their cases.
    tables: BTreeMap<String, [String; 2]>,
    /// What its live cases need, as JSON; none without such cases.
    live: Option<String>,
    /// Numbers of the pictures, as JSON.
    numbers: String,
    thumbnail: String,
}

impl<'a> ScenePart<'a> {
    /// Reads the files of the scene of this number. `has_tables` says if its sections contain the
    /// tables.
    fn read(
        scene: usize,
        report: &RunReport<'a>,
        table: &CaseTable<'a>,
        live: &LiveFiles,
        has_tables: bool,
    ) -> Result<Self, Error> {
        let id = table.scenes[scene];
        let cases: Vec<&Case> = table.cases_on(id).map(|(_, case)| case).collect();
        let mut files = SceneFiles::read(table.run, &cases, report.folder)?;
        let findings: Vec<&Finding> = (report.findings.iter())
            .filter(|finding| finding.scene == *id)
            .collect();
        let (mut views, mut sections) = (Vec::new(), Vec::new());
        let mut is_live = false;
        let mut texts: BTreeMap<String, [String; 2]> = BTreeMap::new();
        for (index, _) in table.cases_on(id) {
            let view = CaseView::read(table.run, index, scene, &findings, &mut files)?;
            let live = live.describe(view.case, scene, &files.whole);
            is_live |= matches!(live, Some(Live::Case(_)));
            let tables = CaseTables::new(&view, table);
            let shown = has_tables.then_some(&tables);
            sections.push(case_section(&view, live.as_ref(), shown));
            if !has_tables {
                texts.extend([tables.texts(view.case)]);
            }
            views.push(view);
        }
        Ok(Self {
            views,
            sections,
            tables: texts,
            live: is_live.then(|| scene_json(&mut files)),
            numbers: files.planes.json(),
            thumbnail: files.thumbnail(),
        })
    }
}
