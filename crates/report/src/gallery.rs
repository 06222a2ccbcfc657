//! Pictures of a run as files: the gallery of best and worst filters, a contact sheet of all truths, and the strip of a case.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use frame::{Image, read_png, tile_pictures, write_atomically, write_png};
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
        let strip = tile_pictures(&strip, 5, GAP, [1.0; 3]);
        write_png(&out.join(strip_name(&best.scene)), &strip)?;
        truths.push(truth);
        page += &section(best, worst);
    }
    let sheet = tile_pictures(&truths, COLUMNS, GAP, [1.0; 3]);
    write_png(&out.join(SHEET), &sheet)?;
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
    Ok(write_png(out, &tile_pictures(&strip, 3, GAP, [1.0; 3]))?)
}

/// Reads the truth that a case is scored against.
fn read_truth(folder: &Path, case: &Case) -> Result<Image, Error> {
    let name = RenderFile::Truth(case.alignment).picture();
    Ok(read_png(&folder.join(case.scene.folder()).join(name))?)
}

/// Reads the output of a case.
fn read_output(folder: &Path, case: &Case) -> Result<Image, Error> {
    Ok(read_png(&folder.join(&case.folder).join("output.png"))?)
}
