//! The command `report`.

use std::path::{Path, PathBuf};
use terminal::refuse;

use clap::Args;
use judge::Judgement;
use measure::{Error, StoredRun, printable_path, write_layers};
use report::{AddToPage, FolderPage, write_gallery};

use run::{RunPage, WrittenFile, page_lines, page_path, write_page};
use terminal::output::{make_monitor, open_page, print, print_json};

/// Contents that other crates add to the page of a run, in their order.
pub const ADDITIONS: [AddToPage; 1] = [bench::add_costs];

/// Kinds of folders without a run that have a page.
const FOLDER_PAGES: [FolderPage; 1] = [tune::TUNING_PAGE];

#[derive(Debug, Args)]
pub struct ReportArgs {
    /// run.json of a finished `run` or `check`, or its folder; or the folder of a `tune search`.
    #[arg(value_name = "RUN", default_value = "out")]
    pub run: PathBuf,
    /// HTML page to write [default: report.html next to run.json, unless --exr or --gallery is
    /// given].
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Open the page in the browser.
    #[arg(long)]
    pub open: bool,
    /// Folder for one multi-layer OpenEXR file per case: truth, output, instant, flip, velocity,
    /// coverage and more.
    #[arg(long, value_name = "DIR")]
    pub exr: Option<PathBuf>,
    /// Folder for a gallery: a page of Markdown, a contact sheet of the truths, each scene with the
    /// best and the worst filter of each shutter.
    #[arg(long, value_name = "DIR")]
    pub gallery: Option<PathBuf>,
    /// Print the list of written files as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Reads a finished run or another folder with a page, and writes the page, and the run's layers if
/// requested.
pub fn execute(args: &ReportArgs) -> Result<(), Error> {
    let find = |page: &FolderPage| (page.find)(&args.run);
    let other = (FOLDER_PAGES.iter()).find_map(|page| Some((page, find(page)?)));
    let (pages, layers) = match other {
        Some((page, folder)) => (write_folder_page(args, page, folder)?, Vec::new()),
        None => write_run_report(args)?,
    };
    if let Some(page) = pages.first().filter(|_| args.open) {
        open_page(&page.path);
    }
    if args.json {
        let written: Vec<&WrittenFile> = pages.iter().chain(&layers).collect();
        return print_json(&written);
    }
    let mut text = page_lines("written", &pages);
    if let Some(folder) = &args.exr {
        let bytes: u64 = layers.iter().map(|file| file.bytes).sum();
        let (count, size) = (layers.len(), bytes as f64 / 1e6);
        text += &format!(
            "written: {count} files below {} ({size:.1} MB)\n",
            printable_path(folder)
        );
    }
    print(&text)
}

/// Writes a run's page and layers; returns the page's files, then the layers'.
fn write_run_report(args: &ReportArgs) -> Result<(Vec<WrittenFile>, Vec<WrittenFile>), Error> {
    let side = StoredRun::read(&args.run)?;
    let (run, folder) = (&side.run, side.folder());
    let is_other_asked = args.exr.is_some() || args.gallery.is_some();
    let mut pages = match &args.html {
        None if is_other_asked => Vec::new(),
        html => {
            let html = page_path(html.as_ref(), folder);
            let judgement = Judgement::read(run, folder)?;
            let (findings, verdict) = match judgement {
                None => (Vec::new(), None),
                Some(judgement) => (judgement.findings, judgement.verdict),
            };
            let page = RunPage {
                run,
                findings: &findings,
                verdict: verdict.as_ref(),
                folder,
                html: &html,
                additions: &ADDITIONS,
            };
            page.write()?
        }
    };
    if let Some(out) = &args.gallery {
        pages.push(WrittenFile::new(write_gallery(run, folder, out)?)?);
    }
    let layers = match &args.exr {
        Some(out) => {
            make_monitor().watch("layers", |watch| write_layers(run, folder, out, watch))?
        }
        None => Vec::new(),
    };
    let layers = layers.into_iter().map(WrittenFile::new);
    Ok((pages, layers.collect::<Result<_, _>>()?))
}

/// Writes the page of a folder without a run.
fn write_folder_page(
    args: &ReportArgs,
    page: &FolderPage,
    folder: &Path,
) -> Result<Vec<WrittenFile>, Error> {
    let options = [
        ("--exr", args.exr.is_some()),
        ("--gallery", args.gallery.is_some()),
    ];
    if let Some((option, _)) = options.iter().find(|(_, given)| *given) {
        refuse!(
            "{option}: {} is a {}, which keeps no pictures; give the folder of a run",
            folder.display(),
            page.kind
        );
    }
    let text = (page.make)(folder)?;
    let html = page_path(args.html.as_ref(), folder);
    Ok(vec![write_page(&text, &html)?])
}
