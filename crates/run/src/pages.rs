//! Files that a command writes: run.json, pages, and the lines that name them.

use std::path::{Path, PathBuf};
use terminal::refuse;

use crate::previous;
use judge::{Finding, Judgement, Verdict};
use measure::{Error, Run, hash_inputs, hash_program, look_up, printable_path, put};
use report::{
    AddToPage, Addition, LARGEST_PAGE, RunReport, SEQUENCES_PAGE, sequences_page, write_report,
};

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

/// Record of the page in a run's folder: a run that makes the same page leaves it.
const PAGE_RECORD: &str = "page.json";

/// A page of a run.
pub struct RunPage<'a> {
    /// The run.
    pub run: &'a Run,
    /// Findings about it.
    pub findings: &'a [Finding],
    /// Verdict of a check.
    pub verdict: Option<&'a Verdict>,
    /// Folder of the run's pictures.
    pub folder: &'a Path,
    /// The page.
    pub html: &'a Path,
    /// Makers of what other crates add.
    pub additions: &'a [AddToPage],
}

impl RunPage<'_> {
    /// Writes the page and the files next to it, and forgets what a run wrote there: pictures may
    /// have been altered since.
    pub fn write(&self) -> Result<Vec<WrittenFile>, Error> {
        // A missing record is as good as removed.
        let _ = std::fs::remove_file(self.folder.join(PAGE_RECORD));
        let files = self.write_files(&self.make_additions()?)?;
        files.into_iter().map(WrittenFile::new).collect()
    }

    /// Writes the page unless it is there already. The run's files are as its `run.json` says:
    /// altered ones have been made again.
    fn write_if_changed(&self) -> Result<Vec<WrittenFile>, Error> {
        let additions = self.make_additions()?;
        let record = self.record(&additions);
        let names =
            (record.as_ref()).and_then(|(path, inputs)| look_up::<Vec<String>>(path, inputs));
        let files = match names {
            Some(names) => names.iter().map(|name| self.folder.join(name)).collect(),
            None => {
                let files = self.write_files(&additions)?;
                let name = |path: &PathBuf| {
                    Some(path.strip_prefix(self.folder).ok()?.to_str()?.to_owned())
                };
                let names = files.iter().map(name).collect::<Option<Vec<String>>>();
                if let (Some((path, inputs)), Some(names)) = (record, names) {
                    put(&path, inputs, &names, &names)?;
                }
                files
            }
        };
        files.into_iter().map(WrittenFile::new).collect()
    }

    fn make_additions(&self) -> Result<Vec<Addition>, Error> {
        let makers = self.additions.iter();
        makers.map(|add| add(self.run, self.folder)).collect()
    }

    fn write_files(&self, additions: &[Addition]) -> Result<Vec<PathBuf>, Error> {
        let report = RunReport {
            run: self.run,
            folder: self.folder,
            findings: self.findings,
            verdict: self.verdict,
            additions,
            largest: LARGEST_PAGE,
        };
        let mut files = write_report(&report, self.html)?;
        if let Some(page) = sequences_page(self.run, self.findings) {
            let path = self.folder.join(SEQUENCES_PAGE);
            frame::write_atomically(&path, page.as_bytes())?;
            files.insert(1, path);
        }
        Ok(files)
    }

    /// Returns the file that records the page, and the hash of all that the page is made of. None
    /// if the page is elsewhere, or if the program cannot be read.
    fn record(&self, additions: &[Addition]) -> Option<(PathBuf, String)> {
        let additions: Vec<String> = additions.iter().map(Addition::text).collect();
        let name = self.html.strip_prefix(self.folder).ok()?;
        let run = self.run.text();
        let inputs = (
            hash_program()?,
            run,
            self.findings,
            self.verdict,
            additions,
            name,
        );
        Some((self.folder.join(PAGE_RECORD), hash_inputs(&inputs)))
    }
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
    let page = RunPage {
        run,
        findings,
        verdict: judgement.verdict.as_ref(),
        folder: out,
        html: &page_path(html, out),
        additions,
    };
    page.write_if_changed()
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
