//! Pages and other files that a command writes, with the lines that name them.

use std::path::{Path, PathBuf};

use report::{LARGEST_PAGE, report};
use suite::{Error, Finding, Run, printable_path};

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

    /// Makes a line: `written: report.html (4.5 MB)`.
    pub fn line(&self, label: &str) -> String {
        format!(
            "{label}: {} ({:.1} MB)\n",
            printable_path(&self.path),
            self.bytes as f64 / 1e6
        )
    }
}

/// Refuses a folder where a file is to be written, before the work that the file is about.
pub fn refuse_folder(option: &str, path: Option<&PathBuf>) -> Result<(), Error> {
    match path.filter(|path| path.is_dir()) {
        None => Ok(()),
        Some(path) => Err(Error::Usage(format!(
            "{option}: {} is a folder; name the file to write",
            path.display()
        ))),
    }
}

/// Writes the page of a run whose pictures lie below `folder`, and the files beside the page.
pub fn write_run_page(
    run: &Run,
    findings: &[Finding],
    folder: &Path,
    html: &Path,
) -> Result<Vec<WrittenFile>, Error> {
    let page = report(run, findings, folder, html, LARGEST_PAGE)?;
    page.write()?;
    let siblings = page.siblings.into_iter().map(|(path, _)| path);
    (std::iter::once(page.html).chain(siblings))
        .map(WrittenFile::new)
        .collect()
}

/// Writes a page.
pub fn write_page(page: &str, html: &Path) -> Result<WrittenFile, Error> {
    frame::write_atomically(html, page.as_bytes())?;
    WrittenFile::new(html.to_owned())
}

/// Makes one line per file.
pub fn written_lines(files: &[WrittenFile]) -> String {
    files.iter().map(|file| file.line("written")).collect()
}
