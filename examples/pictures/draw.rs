//! Pictures made from a run's files, and the text that they show.

use std::fs;
use std::path::{Path, PathBuf};

use frame::{Image, Raster, read_png, tile_pictures, write_png};
use measure::{Case, Error, Run};
use metrics::Metric;
use report::{label, write_case_strip};

use super::browser::Browser;
use super::recipe::{Picture, Screen};

/// Pixels between two pictures of a strip.
const GAP: u32 = 4;

/// Visible lines of a page in its window.
const VISIBLE: &str = "$$('h1, h2, h3, p, li, tr').filter(own => own.checkVisibility() && own.getBoundingClientRect().top >= 0 \
                       && own.getBoundingClientRect().bottom <= innerHeight).map(own => own.innerText.replace(/\\s+/g, ' ').trim())\
                       .filter(text => text).join('\\n')";

/// Makes a strip or a screen at `out`; paths of the run's files are below `below`.
pub fn draw(picture: &Picture, below: &Path, out: &Path) -> Result<(), Error> {
    if let Some(strip) = &picture.strip {
        let parts = strip.iter().map(|(text, file)| {
            let whole = read_png(&below.join(file))?;
            Ok(label(&cut(&whole, picture.middle), text))
        });
        let parts: Vec<Image> = parts.collect::<Result<_, Error>>()?;
        let sheet = tile_pictures(&parts, parts.len() as u32, GAP, [1.0; 3]);
        return Ok(write_png(out, &sheet)?);
    }
    if let Some(folder) = &picture.case {
        let (case, run) = find_case(&below.join(folder))?;
        return write_case_strip(&case, &run, out);
    }
    let screen = picture.screen.as_ref();
    let screen = screen.unwrap_or_else(|| panic!("{}: no way to make it", picture.file));
    let mut browser = open(screen, below)?;
    let [width, height] = screen.size.map(f64::from);
    let bytes = browser.picture_at([0.0, 0.0, width, height]);
    Ok(frame::write_atomically(out, &bytes)?)
}

/// Cuts the middle out of a picture.
fn cut(whole: &Image, middle: Option<[u32; 2]>) -> Image {
    let [width, height] = middle.unwrap_or([whole.width, whole.height]);
    let [left, top] = [(whole.width - width) / 2, (whole.height - height) / 2];
    Raster::from_fn(width, height, |x, y| *whole.at(x + left, y + top))
}

/// Opens a page in a browser of the screen's size.
fn open(screen: &Screen, below: &Path) -> Result<Browser, Error> {
    let page = below.join(&screen.page);
    let page = (page.canonicalize())
        .map_err(|error| Error::Refused(format!("{}: {error}", page.display())))?;
    let mut browser = Browser::new(screen.size[0], screen.size[1]);
    browser.prefer("light");
    browser.open(&page, &screen.part);
    browser.until(
        "!$('#viewer:not([hidden])') || $('#viewer').dataset.drawn === $('#viewer').dataset.asked",
    );
    browser.value("new Promise(done => requestAnimationFrame(() => setTimeout(done, 300)))");
    Ok(browser)
}

/// Returns the scores of the cases that the picture at `path` shows, and the lines of a screen.
pub fn read_text(picture: &Picture, below: &Path, path: &str) -> Result<Vec<String>, Error> {
    let mut lines = Vec::new();
    for source in picture.sources() {
        // The frame and the truth have no score.
        if let Ok((case, _)) = find_case(&below.join(source)) {
            let line = score_line(&case);
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
    }
    if let Some(screen) = &picture.screen {
        let text = open(screen, below)?.text(VISIBLE);
        lines.extend(text.lines().map(str::to_owned));
    }
    if let Some(folder) = &picture.folder {
        let stem = Path::new(path).file_stem().unwrap_or_default();
        let stem = stem.to_string_lossy();
        lines.extend(read_caption(&below.join(folder), &stem));
        lines.extend(read_worst(&picture.cases, &stem)?);
    }
    Ok(lines)
}

/// Reads the score of the case that a picture of a folder is named after.
fn read_worst(runs: &[String], stem: &str) -> Result<Vec<String>, Error> {
    let mut lines = Vec::new();
    for folder in runs {
        let run = Run::read(&Path::new(folder).join("run.json"))?;
        let is_own =
            |case: &&Case| stem == format!("{}_{}", case.name().replace(':', "_"), case.scene);
        lines.extend(run.cases.iter().find(is_own).map(score_line));
    }
    Ok(lines)
}

/// Formats a case's score: `fan / bevy:high 0.150`.
fn score_line(case: &Case) -> String {
    let score = case.score_text(Metric::FLIP);
    format!("{} / {} {score}", case.scene, case.name())
}

/// Finds the line of scores below a picture of a gallery.
fn read_caption(folder: &Path, stem: &str) -> Option<String> {
    let page = fs::read_to_string(folder.join("README.md")).ok()?;
    let section = page
        .split("\n## ")
        .find(|section| section.lines().next() == Some(stem))?;
    let mut lines = section.lines();
    lines
        .find(|line| line.starts_with("Shutter "))
        .map(str::to_owned)
}

/// Finds the case of a file or folder of a run, and the run's folder.
fn find_case(path: &Path) -> Result<(Case, PathBuf), Error> {
    let none = || Error::Refused(format!("{} is of no case", path.display()));
    let mut above = path.ancestors();
    let folder = above
        .find(|folder| folder.join("run.json").is_file())
        .ok_or_else(none)?;
    let run = Run::read(&folder.join("run.json"))?;
    let mut cases = run.cases.into_iter();
    let case = cases.find(|case| path.starts_with(folder.join(&case.folder)));
    Ok((case.ok_or_else(none)?, folder.to_owned()))
}
