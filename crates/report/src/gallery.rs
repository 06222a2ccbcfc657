//! Pictures of a run as files: the gallery of best and worst filters, a contact sheet of all truths, and the strip of a case.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use frame::{Raster, read_png, write_atomically, write_png};
use metrics::Metric;
use store::RenderFile;
use suite::{Case, Error, IDENTITY, Run};
use tracer::SceneId;

use crate::run_facts::command;

/// File name of the contact sheet.
const SHEET: &str = "truths.png";
/// Truths in a row of the contact sheet.
const COLUMNS: u32 = 6;

/// Pixels between two pictures.
const GAP: u32 = 2;

/// Display values in [0, 1].
type Picture = Raster<[f32; 3]>;

/// Writes `README.md`, the contact sheet and a strip of pictures per scene below `out`, from the files of a run in `folder`. Returns
/// the path of the page.
pub fn write_gallery(run: &Run, folder: &Path, out: &Path) -> Result<PathBuf, Error> {
    let entries = find_entries(run);
    if entries.is_empty() {
        return Err(Error::Usage(
            "the run has no filter but identity on a scene that moves, so a gallery has no best and no worst one; run filters"
                .to_owned(),
        ));
    }
    let mut truths = Vec::new();
    let mut page = introduction(run);
    for [best, worst] in entries {
        let instant = read_png(&folder.join(best.scene.folder()).join("frame.png"))?;
        let truth = read_truth(folder, best)?;
        let strip = [
            instant,
            truth.clone(),
            read_output(folder, best)?,
            read_truth(folder, worst)?,
            read_output(folder, worst)?,
        ];
        write_png(&out.join(strip_name(&best.scene)), &tile(&strip, 5))?;
        truths.push(truth);
        page += &section(best, worst);
    }
    write_png(&out.join(SHEET), &tile(&truths, COLUMNS))?;
    let path = out.join("README.md");
    write_atomically(&path, page.as_bytes())?;
    Ok(path)
}

/// Finds the best and the worst filter, scene by scene, in the order of the run.
fn find_entries(run: &Run) -> Vec<[&Case; 2]> {
    let cases: Vec<&Case> = (run.cases.iter())
        .filter(|case| !case.is_reference && case.filter != IDENTITY)
        .collect();
    cases
        .chunk_by(|a, b| a.scene == b.scene)
        .filter_map(find_entry)
        .collect()
}

/// Ranks the filters of one scene by skill; by FLIP against the common shutter where the oracle is no better than no blur,
/// so that there is no skill. None where nothing moves.
fn find_entry<'a>(cases: &[&'a Case]) -> Option<[&'a Case; 2]> {
    let skills = cases.iter().map(|case| case.estimate(Metric::SKILL));
    let errors = (cases.iter()).map(|case| Some(-case.estimate(Metric::CommonFlip)?));
    let keys: Vec<f64> = (skills.collect::<Option<_>>()).or_else(|| errors.collect())?;
    let ranked = || keys.iter().zip(cases);
    let (_, best) = ranked().max_by(|(a, _), (b, _)| a.total_cmp(b))?;
    let (_, worst) = ranked().min_by(|(a, _), (b, _)| a.total_cmp(b))?;
    Some([best, worst])
}

fn introduction(run: &Run) -> String {
    format!(
        "# Gallery\n\n![The truths of all scenes]({SHEET})\n\nBelow, each scene has five pictures: the frame of one instant; the truth and the \
         output of the best filter; the truth and the output of the worst filter. Two truths differ where the filters declare two \
         shutters. Best and worst are by skill, the share of the way from no blur (0) to the one-frame oracle (1). Where no skill \
         applies, FLIP* decides: FLIP against one shutter for all filters. The filter that does nothing takes no part.\n\n{}x{} pixels, {} samples per pixel. Made from\n\n    {}\n\nby `shuttertruth report --gallery`.\n",
        run.render.width,
        run.render.height,
        run.render.samples_per_pixel,
        command(run),
    )
}

fn section(best: &Case, worst: &Case) -> String {
    let mut text = format!("\n## {}\n\n{}\n\n", best.scene, best.exposes);
    let _ = writeln!(
        text,
        "![{}: instant; truth and best filter; truth and worst filter]({})\n\n| | filter | shutter | skill | FLIP | FLIP* |\n|---|---|---|---|---|---|",
        best.scene,
        strip_name(&best.scene)
    );
    for (label, case) in [("best", best), ("worst", worst)] {
        let [skill, flip, common] =
            [Metric::SKILL, Metric::FLIP, Metric::CommonFlip].map(|score| case.score_text(score));
        let name = case.name();
        let _ = writeln!(
            text,
            "| {label} | `{name}` | {} | {skill} | {flip} | {common} |",
            case.alignment
        );
    }
    text
}

fn strip_name(scene: &SceneId) -> String {
    format!("{scene}.png")
}

/// Writes truth, output and FLIP of a case side by side to the PNG file `out`; `folder` is that of its run.json.
///
/// # Errors
/// A picture of the case cannot be read, or the file cannot be written.
pub fn write_case_strip(case: &Case, folder: &Path, out: &Path) -> Result<(), Error> {
    let flip = read_png(&folder.join(&case.folder).join("flip.png"))?;
    let strip = [read_truth(folder, case)?, read_output(folder, case)?, flip];
    Ok(write_png(out, &tile(&strip, 3))?)
}

/// Reads the truth that a case is scored against.
fn read_truth(folder: &Path, case: &Case) -> Result<Picture, Error> {
    let name = RenderFile::Truth(case.alignment).picture();
    Ok(read_png(&folder.join(case.scene.folder()).join(name))?)
}

/// Reads the output of a case.
fn read_output(folder: &Path, case: &Case) -> Result<Picture, Error> {
    Ok(read_png(&folder.join(&case.folder).join("output.png"))?)
}

/// Places pictures of one size side by side, `columns` in a row, on white.
fn tile(pictures: &[Picture], columns: u32) -> Picture {
    let (width, height) = (pictures[0].width + GAP, pictures[0].height + GAP);
    let columns = columns.min(pictures.len() as u32);
    let rows = (pictures.len() as u32).div_ceil(columns);
    Raster::from_fn(columns * width - GAP, rows * height - GAP, |x, y| {
        let index = (y / height) * columns + x / width;
        let picture = pictures.get(index as usize);
        let inside = picture.filter(|it| x % width < it.width && y % height < it.height);
        inside.map_or([1.0; 3], |picture| *picture.at(x % width, y % height))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_stand_in_rows_with_gaps_between() {
        let pictures: Vec<Picture> = (0..3)
            .map(|index| Raster::filled(2, 1, [0.25 * index as f32; 3]))
            .collect();
        let sheet = tile(&pictures, 2);
        assert_eq!((sheet.width, sheet.height), (2 * 4 - 2, 2 * 3 - 2));
        assert_eq!(*sheet.at(0, 0), [0.0; 3]);
        assert_eq!(*sheet.at(2, 0), [1.0; 3]);
        assert_eq!(*sheet.at(4, 0), [0.25; 3]);
        assert_eq!(*sheet.at(1, 3), [0.5; 3]);
        assert_eq!(*sheet.at(5, 3), [1.0; 3], "no third column");
    }
}
