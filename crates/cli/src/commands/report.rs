//! `shuttertruth report`

use std::path::{Path, PathBuf};

use crate::output::progress::monitor;
use report::{LARGEST_PAGE, TuneFolder, gallery, report, tuning_page};
use suite::{Error, Finding, Judgement, Run, printable_path, write_layers};

use super::say;
use crate::arguments::ReportArgs;

/// Reads a finished run, or a tuning, and writes its page, and its layers where they are asked for.
pub fn execute(args: &ReportArgs) -> Result<(), Error> {
    let (pages, layers) = match subject(&args.run) {
        Subject::Run(path) => of_run(args, &path)?,
        Subject::Tuning(folder) => (of_tuning(args, &folder)?, Vec::new()),
    };
    if args.json {
        let written: Vec<&Written> = pages.iter().chain(&layers).collect();
        let json = serde_json::to_string_pretty(&written).expect("a list of paths is plain data");
        return say(&format!("{json}\n"));
    }
    let mut text: String = pages.iter().map(Written::line).collect();
    if let Some(folder) = &args.exr {
        let bytes: u64 = layers.iter().map(|file| file.bytes).sum();
        let (count, size) = (layers.len(), bytes as f64 / 1e6);
        text += &format!(
            "written: {count} files below {} ({size:.1} MB)\n",
            printable_path(folder)
        );
    }
    say(&text)
}

enum Subject {
    /// A run.json.
    Run(PathBuf),
    /// A folder.
    Tuning(PathBuf),
}

/// What lies there, by the names that `run` and `tune` give to their files.
fn subject(path: &Path) -> Subject {
    let run = path.join("run.json");
    let file = path.file_name().unwrap_or_default();
    if path.is_dir() && run.is_file() {
        Subject::Run(run)
    } else if path.is_dir() {
        Subject::Tuning(path.to_owned())
    } else if file == "tune.json" || file == "sensitivity.json" {
        Subject::Tuning(path.parent().unwrap_or(Path::new("")).to_owned())
    } else {
        Subject::Run(path.to_owned())
    }
}

/// The page's files, and those of the layers.
fn of_run(args: &ReportArgs, path: &Path) -> Result<(Vec<Written>, Vec<Written>), Error> {
    let run = Run::read(path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut pages = match &args.html {
        Some(html) => {
            let judgement = Judgement::read(&run, folder)?;
            let findings = judgement.map_or_else(Vec::new, |judgement| judgement.findings);
            write_report_files(&run, &findings, folder, html)?
        }
        None => Vec::new(),
    };
    if let Some(own) = &args.gallery {
        pages.push(Written::of(gallery(&run, folder).write(own)?)?);
    }
    let layers = match &args.exr {
        Some(out) => {
            monitor(args.quiet).watch("layers", |watch| write_layers(&run, folder, out, watch))?
        }
        None => Vec::new(),
    };
    let layers = layers.into_iter().map(Written::of);
    Ok((pages, layers.collect::<Result<_, _>>()?))
}

fn of_tuning(args: &ReportArgs, folder: &Path) -> Result<Vec<Written>, Error> {
    let option = [
        ("--exr", args.exr.is_some()),
        ("--gallery", args.gallery.is_some()),
    ];
    if let Some((option, _)) = option.iter().find(|(_, given)| *given) {
        return Err(Error::Usage(format!(
            "{option}: {} is a tuning, which keeps no pictures; give the folder of a run",
            folder.display()
        )));
    }
    let page = tuning_page(&TuneFolder::read(folder)?)?;
    let html = (args.html.as_deref()).expect("clap requires a page where there are no layers");
    Ok(vec![write_page(&page, html)?])
}

/// A file that is there now.
#[derive(serde::Serialize)]
pub struct Written {
    /// Where.
    pub path: PathBuf,
    /// How large.
    pub bytes: u64,
}

impl Written {
    fn of(path: PathBuf) -> Result<Self, Error> {
        let found = std::fs::metadata(&path)
            .map_err(|source| frame::FileError::io(&path, "read", source))?;
        Ok(Self {
            bytes: found.len(),
            path,
        })
    }

    /// `written: report.html (4.5 MB)`
    pub fn line(&self) -> String {
        format!(
            "written: {} ({:.1} MB)\n",
            printable_path(&self.path),
            self.bytes as f64 / 1e6
        )
    }
}

/// Writes the page of a run whose pictures lie below `folder`; returns the lines that say so.
pub fn write_report(
    run: &Run,
    findings: &[Finding],
    folder: &Path,
    html: &Path,
) -> Result<String, Error> {
    let written = write_report_files(run, findings, folder, html)?;
    Ok(written.iter().map(Written::line).collect())
}

/// Writes the page of a run, and whatever has to lie beside it.
fn write_report_files(
    run: &Run,
    findings: &[Finding],
    folder: &Path,
    html: &Path,
) -> Result<Vec<Written>, Error> {
    let report = report(run, findings, folder, html, LARGEST_PAGE)?;
    report.write()?;
    let beside = report.siblings.into_iter().map(|(path, _)| path);
    (std::iter::once(report.html).chain(beside))
        .map(Written::of)
        .collect()
}

/// Writes a page.
pub fn write_page(page: &str, html: &Path) -> Result<Written, Error> {
    frame::write_atomically(html, page.as_bytes())?;
    Written::of(html.to_owned())
}
