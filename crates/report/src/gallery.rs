//! Picture files of a run: the gallery of best and worst filters, a contact sheet of all truths,
//! and the strip of a case.

use std::path::{Path, PathBuf};

use frame::{Alignment, Image, read_png, tile_pictures, write_atomically, write_jpeg, write_png};
use measure::{
    Case, Error, IDENTITY, RenderFile, Run, escape_markdown, markdown_code, printable,
    printable_path,
};
use metrics::Metric;

use crate::label::label;
use crate::run_facts::command;

/// File name of the contact sheet.
const SHEET: &str = "truths.png";
/// Truths in a row of the contact sheet.
const COLUMNS: u32 = 6;

/// Pixels between two pictures.
const GAP: u32 = 2;

/// Best and worst filter of one shutter on a scene.
struct Extremes<'a> {
    best: &'a Case,
    worst: &'a Case,
}

/// Writes `README.md`, the contact sheet and a picture per scene below `out`, from the files of a
/// run in `folder`. Returns the page's path.
pub fn write_gallery(run: &Run, folder: &Path, out: &Path) -> Result<PathBuf, Error> {
    let scenes = find_extremes(run);
    if scenes.is_empty() {
        return Err(Error::Refused(
            "the run has no filter but identity on a scene that moves, so a gallery has no best and no worst one; run filters"
                .to_owned(),
        ));
    }
    let mut truths = Vec::new();
    let mut page = introduction(run, folder, out);
    for shutters in &scenes {
        let scene = &shutters[0].best.scene;
        let mut pictures = Vec::new();
        for extremes in shutters {
            pictures.extend(rows(folder, extremes)?);
        }
        let picture = tile_pictures(&pictures, 3, GAP, [1.0; 3]);
        write_jpeg(&out.join(format!("{scene}.jpg")), &picture)?;
        truths.push(read_truth(folder, shutters[0].best)?);
        page += &section(shutters);
    }
    let sheet = tile_pictures(&truths, COLUMNS, GAP, [1.0; 3]);
    write_png(&out.join(SHEET), &sheet)?;
    let path = out.join("README.md");
    write_atomically(&path, page.as_bytes())?;
    Ok(path)
}

/// Finds the best and the worst filter of each shutter for each scene, in the order of the run.
fn find_extremes(run: &Run) -> Vec<Vec<Extremes<'_>>> {
    let cases: Vec<&Case> = (run.cases.iter())
        .filter(|case| !case.is_reference && case.filter != IDENTITY)
        .collect();
    cases
        .chunk_by(|a, b| a.scene == b.scene)
        .map(|cases| {
            let of = |alignment| Extremes::of(cases, alignment);
            [Alignment::Centred, Alignment::Trailing]
                .into_iter()
                .filter_map(of)
                .collect::<Vec<_>>()
        })
        .filter(|shutters| !shutters.is_empty())
        .collect()
}

impl<'a> Extremes<'a> {
    /// Ranks the filters of one shutter by FLIP; none if nothing moves.
    fn of(cases: &[&'a Case], alignment: Alignment) -> Option<Self> {
        let mut ranked: Vec<(f64, &Case)> = (cases.iter())
            .filter(|case| case.alignment == alignment)
            .filter_map(|case| Some((case.estimate(Metric::FLIP)?, *case)))
            .collect();
        ranked.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let &(_, best) = ranked.first()?;
        let &(_, worst) = ranked.last()?;
        Some(Self { best, worst })
    }
}

fn introduction(run: &Run, folder: &Path, out: &Path) -> String {
    format!(
        "# Gallery\n\nSee where filters succeed and fail: every scene with the best and the worst filter of each shutter.\n\n![The truths of \
         all scenes]({SHEET})\n\nEach scene has two rows per shutter: the truth, the best filter and its FLIP error map; the frame of \
         one instant, the\nworst filter and its error map. In an error map, black is no visible difference. The line below names the \
         best and the worst filter,\nwith FLIP where anything moves; lower is better. Compare filters of one shutter only. The filter \
         `identity` is left out.\n\nThe pictures have {}x{} pixels; the truths have {} samples per pixel. These commands make them:\n\n    \
         {}\n    shuttertruth report {} --gallery {}\n",
        run.render.width,
        run.render.height,
        run.render.samples_per_pixel,
        printable(&command(run)),
        printable_path(folder),
        printable_path(out),
    )
}

fn section(shutters: &[Extremes]) -> String {
    let scene = &shutters[0].best.scene;
    let exposes = &shutters[0].best.exposes;
    let text = |extremes: &Extremes| {
        let [best, worst] = [extremes.best, extremes.worst].map(|case| {
            format!(
                "{} {}",
                markdown_code(&case.name()),
                case.score_text(Metric::FLIP)
            )
        });
        format!("{}: {best}, {worst}", extremes.best.alignment)
    };
    let texts: Vec<String> = shutters.iter().map(text).collect();
    let [scene, exposes] = [scene.to_string(), exposes.clone()].map(|text| escape_markdown(&text));
    format!(
        "\n## {scene}\n\n{exposes}\n\n![{scene}]({scene}.jpg)\n\nShutter {}\n",
        texts.join("; ")
    )
}

/// Reads the two rows of a shutter: truth, best filter and its error map; instant, worst filter and
/// its error map.
fn rows(folder: &Path, extremes: &Extremes) -> Result<Vec<Image>, Error> {
    let Extremes { best, worst } = extremes;
    let instant = read_png(&folder.join(best.scene.folder()).join("frame.png"))?;
    let [_, output, flip] = strip(worst, folder, "", " worst")?;
    let lower = [label(&instant, "instant"), output, flip];
    Ok(strip(best, folder, &best.alignment.to_string(), " best")?
        .into_iter()
        .chain(lower)
        .collect())
}

/// Reads truth, output and FLIP of a case, and labels them; `truth` and `score` follow the truth's
/// and the error's labels.
fn strip(case: &Case, folder: &Path, truth: &str, score: &str) -> Result<[Image; 3], Error> {
    let flip = read_png(&folder.join(&case.folder).join("flip.png"))?;
    let output = read_png(&folder.join(&case.folder).join("output.png"))?;
    let [truth, score] = [
        format!("truth {truth}"),
        format!("FLIP {}{score}", case.score_text(Metric::FLIP)),
    ];
    Ok([
        label(&read_truth(folder, case)?, &truth),
        label(&output, &case.name()),
        label(&flip, &score),
    ])
}

/// Writes truth, output and FLIP of a case side by side to the PNG file `out`; `folder` is its
/// run.json's.
///
/// # Errors
/// A picture of the case cannot be read, or the file cannot be written.
pub fn write_case_strip(case: &Case, folder: &Path, out: &Path) -> Result<(), Error> {
    let pictures = strip(case, folder, &case.scene.to_string(), "")?;
    Ok(write_png(out, &tile_pictures(&pictures, 3, GAP, [1.0; 3]))?)
}

/// Reads a case's truth.
fn read_truth(folder: &Path, case: &Case) -> Result<Image, Error> {
    let name = RenderFile::Truth(case.alignment).picture();
    Ok(read_png(&folder.join(case.scene.folder()).join(name))?)
}
