//! Files that a command writes: run.json, pages, and the lines that name them.

use std::path::{Path, PathBuf};
use terminal::refuse;

use crate::previous;
use judge::{Finding, Judgement, Verdict};
use measure::{Error, Run, printable_path};
use report::{AddToPage, LARGEST_PAGE, RunReport, SEQUENCES_PAGE, sequences_page, write_report};

/// A file that a command wrote.
#[derive(serde::Serialize)]
pub struct WrittenFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Size in bytes.
    pub bytes: u64,
}

impl WrittenFile {
    /// Looks up the size of a file.
    pub fn new(path: PathBuf) -> Result<Self, Error> {
        let metadata = std::fs::metadata(&path)
            .map_err(|source| frame::FileError::io(&path, "read", source))?;
        Ok(Self {
            bytes: metadata.len(),
            path,
        })
    }

    /// Formats a line: `written: report.html (4.5 MB)`.
    pub fn line(&self, label: &str) -> String {
        format!(
            "{label}: {} ({:.1} MB)\n",
            printable_path(&self.path),
            self.bytes as f64 / 1e6
        )
    }
}

/// Refuses a folder as the file to write, before the work starts.
pub fn refuse_folder(option: &str, path: Option<&PathBuf>) -> Result<(), Error> {
    match path.filter(|path| path.is_dir()) {
        None => Ok(()),
        Some(path) => refuse!(
            "{option}: {} is a folder; name the file to write",
            path.display()
        ),
    }
}

/// Returns the requested page, or report.html in a folder.
pub fn page_path(html: Option<&PathBuf>, folder: &Path) -> PathBuf {
    html.cloned().unwrap_or_else(|| folder.join("report.html"))
}

/// Writes the page of a run with pictures below `folder`, and the page's files next to it.
/// `additions` make what other crates add.
pub fn write_run_page(
    run: &Run,
    findings: &[Finding],
    verdict: Option<&Verdict>,
    folder: &Path,
    html: &Path,
    additions: &[AddToPage],
) -> Result<Vec<WrittenFile>, Error> {
    let additions = additions.iter().map(|add| add(run, folder));
    let report = RunReport {
        run,
        folder,
        findings,
        verdict,
        additions: &additions.collect::<Result<Vec<_>, _>>()?,
        largest: LARGEST_PAGE,
    };
    let mut files = write_report(&report, html)?;
    if let Some(page) = sequences_page(run, findings) {
        let path = folder.join(SEQUENCES_PAGE);
        frame::write_atomically(&path, page.as_bytes())?;
        files.insert(1, path);
    }
    files.into_iter().map(WrittenFile::new).collect()
}

/// Writes `run.json`. What it replaces becomes the previous run.
pub fn write_run(run: &Run, out: &Path) -> Result<(), Error> {
    frame::write_atomically(&out.join("run.json"), run.text().as_bytes())?;
    previous::finish(out)
}

/// Writes the findings about a run, whose `run.json` is written, and the page.
pub fn write_judgement(
    run: &Run,
    findings: &[Finding],
    verdict: Option<Verdict>,
    out: &Path,
    html: Option<&PathBuf>,
    additions: &[AddToPage],
) -> Result<Vec<WrittenFile>, Error> {
    let judgement = Judgement::new(out, findings.to_vec(), verdict)?;
    judgement.write(out)?;
    let verdict = judgement.verdict.as_ref();
    write_run_page(
        run,
        findings,
        verdict,
        out,
        &page_path(html, out),
        additions,
    )
}

/// Writes a page.
pub fn write_page(page: &str, html: &Path) -> Result<WrittenFile, Error> {
    frame::write_atomically(html, page.as_bytes())?;
    WrittenFile::new(html.to_owned())
}

/// Formats one line per page, and one for all files that a page loads.
pub fn page_lines(label: &str, files: &[WrittenFile]) -> String {
    let is_loaded = |file: &&WrittenFile| {
        file.path
            .extension()
            .is_some_and(|extension| extension == "js")
    };
    let (loaded, pages): (Vec<_>, Vec<_>) = files.iter().partition(is_loaded);
    let mut text: String = pages.iter().map(|page| page.line(label)).collect();
    if let Some(folder) = loaded.first().and_then(|file| file.path.parent()) {
        let bytes: u64 = loaded.iter().map(|file| file.bytes).sum();
        text += &format!(
            "{label}: {} files in {} ({:.1} MB), which the page loads\n",
            loaded.len(),
            printable_path(folder),
            bytes as f64 / 1e6
        );
    }
    text
}

#[test]
fn files_that_a_page_loads_share_a_line() {
    let file = |path: &str| WrittenFile {
        path: path.into(),
        bytes: 1_500_000,
    };
    let names = [
        "out/report.html",
        "out/report_files/scene_0.js",
        "out/report_files/scene_1.js",
    ];
    assert_eq!(
        page_lines("report", &names.map(file)),
        "report: out/report.html (1.5 MB)\nreport: 2 files in out/report_files (3.0 MB), which the page loads\n"
    );
}
