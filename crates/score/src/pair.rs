//! The command `score` for a picture and a reference picture.

use std::path::{Path, PathBuf};

use filters::Convention;
use frame::{
    Display, ExrFile, FlipExposures, Image, Plane, Raster, Size, find_broken, read_passes,
};
use measure::{
    ComparedPictures, Error, Mattes, PictureFile, PicturePair, bright_note, compare_pictures,
    mark_reached, missing_in_pair, read_convention, read_motion, read_picture, reference_shutter,
    shorten_names,
};
use metrics::{ImageMetric, Metric, Region, Scores};
use report::{NamedPicture, PicturePage, picture_page};
use run::{page_lines, refuse_folder, write_page};
use terminal::output::{Text, heading, print, print_json, push_wrapped};
use terminal::refuse;
use terminal::table::{Table, legend_text};

use crate::args::{ScoreArgs, name_file};

/// FLIP over the whole picture, as other programs compute it.
const WHOLE: Metric = Metric::Image(ImageMetric::Flip, Region::Full);
/// Columns of the table: titles and errors of colour.
const COLUMNS: [(&str, ImageMetric); 5] = [
    ("FLIP", ImageMetric::Flip),
    ("FLIP p95", ImageMetric::FlipP95),
    ("HDR-FLIP", ImageMetric::FlipHdr),
    ("PSNR", ImageMetric::Psnr),
    ("SSIM", ImageMetric::Ssim),
];
/// Meaning of the titles.
const KEY: &str = "FLIP as NVIDIA's tool computes it: 0 is equal; p95 is exceeded in a twentieth of the pixels. PSNR in dB and SSIM: \
                   higher is better.";
/// Meaning of the title that scene-linear pictures have besides.
const HDR_KEY: &str =
    " HDR-FLIP is the most over exposures from -2 to 2 stops about that of --stops.";
/// Prefix of the channels of mattes.
const COVERAGE: &str = "coverage.";
/// Exposure for velocity per shutter: marked is what moves within as much on either side.
const EXPOSURE: f64 = 0.5;

/// All that the files hold.
struct Inputs {
    reference: PictureFile,
    image: PictureFile,
    frame: Option<PictureFile>,
    moving: Option<Raster<bool>>,
    mattes: Option<Mattes>,
    /// Sentences about how each file was read.
    notes: Vec<String>,
}

/// Scores a picture against a reference; prints the scores, and what the others need.
pub fn execute(args: &ScoreArgs, reference: &Path) -> Result<(), Error> {
    refuse_folder("--html", args.html.as_ref())?;
    let inputs = read_inputs(args, reference)?;
    let flip = FlipExposures::default();
    let display = Display {
        stops: args.stops,
        flip: FlipExposures {
            start: args.stops + flip.start,
            stop: args.stops + flip.stop,
            ..flip
        },
    };
    let pair = PicturePair {
        reference: &inputs.reference.color,
        image: &inputs.image.color,
        frame: inputs.frame.as_ref().map(|frame| &frame.color),
        moving: inputs.moving.as_ref(),
        mattes: inputs.mattes.as_ref(),
        display,
        display_referred: is_for_display(&inputs),
    };
    let compared = compare_pictures(&pair)
        .map_err(|error| Error::Refused(format!("{}: {error}", args.image.display())))?;
    let missing = missing_in_pair(&compared.measurement.scores);
    let mut written = None;
    if let Some(html) = &args.html {
        let page = make_page(args, reference, &inputs, &compared, &missing);
        written = Some(write_page(&page, html)?);
    }
    if args.json {
        return print_json(&serde_json::json!({
            "format": measure::FORMAT,
            "program": measure::PROGRAM,
            "image": args.image,
            "reference": reference,
            "notes": inputs.notes,
            "scores": compared.measurement.scores,
            "no_blur": compared.no_blur,
        }));
    }
    let mut text: Text = inputs
        .notes
        .iter()
        .map(|note| format!("{note}\n"))
        .collect::<String>()
        .into();
    text += "\n";
    text += score_rows(args, &inputs, &compared);
    text += missing_text(&missing);
    print(text + page_lines("written", written.as_slice()))
}

fn is_for_display(inputs: &Inputs) -> bool {
    [&inputs.reference, &inputs.image]
        .iter()
        .any(|file| file.kind.is_display_referred())
}

/// Reads all files, and refuses pictures of two sizes.
fn read_inputs(args: &ScoreArgs, reference: &Path) -> Result<Inputs, Error> {
    let convention = read_convention(args.convention.as_deref())?;
    let mut notes = Vec::new();
    let mut read = |path: &Path| -> Result<PictureFile, Error> {
        let file = read_picture(path, &convention, args.stops)?;
        check_finite(path, &file.color)?;
        let name = name_file(path);
        notes.push(format!("{name}: {}", file.reading));
        notes.extend(file.notes.iter().map(|note| format!("{name}: {note}")));
        Ok(file)
    };
    let truth = read(reference)?;
    let image = read(&args.image)?;
    let frame = args.frame.as_deref().map(read).transpose()?;
    let expected = (reference, truth.color.size());
    check_size(&args.image, image.color.size(), expected)?;
    if let (Some(path), Some(frame)) = (&args.frame, &frame) {
        check_size(path, frame.color.size(), expected)?;
    }
    if image.kind.is_display_referred() {
        notes.extend(bright_note(&truth.color, args.stops, &name_file(reference)));
    }
    let moving = (args.velocity.as_deref())
        .map(|path| read_moving(path, &convention, expected))
        .transpose()?;
    Ok(Inputs {
        mattes: read_mattes(&args.mattes, expected)?,
        reference: truth,
        image,
        frame,
        moving,
        notes,
    })
}

/// Refuses a picture with NaN or infinity, and names the pixel.
fn check_finite(path: &Path, color: &Image) -> Result<(), Error> {
    let Some(at) = find_broken(color.pixels.as_flattened(), f32::NEG_INFINITY) else {
        return Ok(());
    };
    let at = at / 3;
    let (x, y) = (at % color.width as usize, at / color.width as usize);
    refuse!(
        "{}: holds {:?} at pixel ({x}, {y}); every number must be finite",
        path.display(),
        color.pixels[at]
    )
}

/// Refuses a file of another size than the reference.
fn check_size(path: &Path, size: Size, (reference, expected): (&Path, Size)) -> Result<(), Error> {
    if size == expected {
        Ok(())
    } else {
        refuse!(
            "{}: has {size} pixels, {} has {expected}; both need one size: render or crop them alike, without scaling",
            path.display(),
            reference.display()
        )
    }
}

/// Marks the pixels that something crosses within half a frame, by its velocity.
fn read_moving(
    path: &Path,
    convention: &Convention,
    expected: (&Path, Size),
) -> Result<Raster<bool>, Error> {
    let velocity = read_motion(path, convention, EXPOSURE)?;
    check_size(path, velocity.size(), expected)?;
    Ok(mark_reached(&velocity, reference_shutter()))
}

/// Reads the mattes of the reference and of the picture; none if no files are named.
fn read_mattes(paths: &[PathBuf], expected: (&Path, Size)) -> Result<Option<Mattes>, Error> {
    let [reference, image] = paths else {
        return Ok(None);
    };
    let [first, second] = [reference, image].map(|path| read_coverage(path, expected));
    let ((objects, reference_mattes), (others, image_mattes)) = (first?, second?);
    if objects != others {
        refuse!(
            "{}: has mattes of {}, {} of {}; both need the same objects",
            image.display(),
            others.join(", "),
            reference.display(),
            objects.join(", ")
        );
    }
    Ok(Some(Mattes {
        objects,
        reference: reference_mattes,
        image: image_mattes,
    }))
}

/// Reads the objects of a file and their mattes, the background first. It has the rest if the file
/// does not name it.
fn read_coverage(path: &Path, expected: (&Path, Size)) -> Result<(Vec<String>, Vec<Plane>), Error> {
    const BACKGROUND: &str = "background";
    let file: ExrFile = read_passes(path)?;
    check_size(path, file.size(), expected)?;
    let names = file
        .channels
        .iter()
        .filter_map(|channel| channel.name.strip_prefix(COVERAGE));
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    names.sort_by_key(|name| (name != BACKGROUND, name.clone()));
    if names.iter().all(|name| name == BACKGROUND) {
        refuse!(
            "{}: has no mattes; needed: channels {COVERAGE}<object>, each object's share of a pixel",
            path.display()
        );
    }
    let planes = names
        .iter()
        .map(|name| file.plane(&format!("{COVERAGE}{name}")));
    let mut planes = planes.collect::<Result<Vec<Plane>, _>>()?;
    if names[0] != BACKGROUND {
        let nothing = planes[0].map(|_| 1.0);
        let rest = planes.iter().fold(nothing, |rest, plane| {
            rest.zip(plane, |rest, share| rest - share)
        });
        names.insert(0, BACKGROUND.to_owned());
        planes.insert(0, rest);
    }
    Ok((names, planes))
}

fn make_page(
    args: &ScoreArgs,
    reference: &Path,
    inputs: &Inputs,
    compared: &ComparedPictures,
    missing: &[(String, Vec<Metric>)],
) -> String {
    fn named<'a>(path: &Path, color: &'a Image) -> NamedPicture<'a> {
        NamedPicture {
            name: name_file(path),
            color,
        }
    }
    let frame = args.frame.as_deref().zip(inputs.frame.as_ref());
    picture_page(&PicturePage {
        image: named(&args.image, &inputs.image.color),
        reference: named(reference, &inputs.reference.color),
        frame: frame.map(|(path, frame)| named(path, &frame.color)),
        maps: &compared.measurement.maps,
        regions: &compared.regions,
        scores: &compared.measurement.scores,
        headline: WHOLE,
        missing,
        stops: args.stops,
        notes: &inputs.notes,
    })
}

/// Makes the table of the scores of colour, for the whole picture and for what moves.
fn score_rows(args: &ScoreArgs, inputs: &Inputs, compared: &ComparedPictures) -> Text {
    let is_shown = |metric| metric != ImageMetric::FlipHdr || !is_for_display(inputs);
    let columns: Vec<_> = (COLUMNS.into_iter())
        .filter(|(_, metric)| is_shown(*metric))
        .collect();
    let mut table = Table::new("picture", columns.iter().map(|(title, _)| *title));
    let mut push = |title: &str, region: Region| {
        let cells = |scores: &Scores| -> Vec<String> {
            let metrics = columns
                .iter()
                .map(|(_, metric)| Metric::Image(*metric, region));
            metrics
                .map(|metric| scores.text(metric, scores.get(metric).value()))
                .collect()
        };
        table.push_text(heading(title));
        table.push(name_file(&args.image), cells(&compared.measurement.scores));
        if let (Some(path), Some(scores)) = (&args.frame, &compared.no_blur) {
            table.push_row(
                true,
                format!("[no blur: {}]", name_file(path)),
                cells(scores),
            );
        }
    };
    push("whole picture", Region::Full);
    if inputs.moving.is_some() {
        let moving = compared.regions.indices(Region::Moving).count() as f64;
        let share = 100.0 * moving / inputs.image.color.size().pixels() as f64;
        push(
            &format!("what moves, {share:.0} % of the picture"),
            Region::Moving,
        );
    }
    let more = if is_for_display(inputs) { "" } else { HDR_KEY };
    table.text() + legend_text(&format!("{KEY}{more}"))
}

/// Lists the scores that are left out, and what they need.
fn missing_text(missing: &[(String, Vec<Metric>)]) -> Text {
    let mut text = Text::default();
    for (reason, metrics) in missing {
        let names = shorten_names(metrics).join(", ");
        push_wrapped(&mut text, 0, format!("left out: {names}: {reason}"));
    }
    text
}
