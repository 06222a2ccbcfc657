//! The command `score`.

use std::path::Path;
use terminal::refuse;

use frame::{Frame, Image, Ladder, Provenance, Truth};
use measure::{
    Error, IngestedScene, NO_VELOCITY, Scored, engine_name, missing_scores, printable,
    read_convention, read_finished_picture, score,
};
use metrics::{Metric, Smear};

use crate::args::{ScoreArgs, name_file};
use report::{NamedPicture, PicturePage, picture_page};
use run::{page_lines, refuse_folder, score_table, shows_smears, write_page};
use terminal::output::{Text, print, print_json};

/// Scores one finished picture; prints the scores, and those that its file does not allow.
pub fn execute(args: &ScoreArgs) -> Result<(), Error> {
    refuse_folder("--html", args.html.as_ref())?;
    let [truth_path, frame_path] = args.truth_files();
    let truth = Truth::read(truth_path)?;
    let frame = Frame::read(frame_path)?;
    let ladder = args.ladder.as_deref().map(Ladder::read).transpose()?;
    check_scene(frame_path, &frame.provenance, &truth)?;
    if let (Some(path), Some(ladder)) = (&args.ladder, &ladder) {
        check_scene(path, &ladder.provenance, &truth)?;
    }
    let convention = read_convention(args.convention.as_deref())?;
    let picture = read_finished_picture(&args.image, &convention, &frame, &truth)?;
    let mut scored = score(&picture, &frame, &truth, ladder.as_ref())
        .map_err(|error| Error::Refused(format!("{}: {error}", args.image.display())))?;
    if lacks_velocity(truth_path)? {
        scored.scores.take_out_motion(NO_VELOCITY);
        scored.smear = None;
    }
    let mut written = None;
    if let Some(html) = &args.html {
        let page = make_page(args, &picture.color, &frame, &truth, &scored);
        written = Some(write_page(&page, html)?);
    }
    if args.json {
        let mut json = scored_json(args, &truth, &scored.notes, &scored.scores);
        json["smear"] = serde_json::json!(scored.smear);
        json["truth_hash"] = truth.provenance.content_hash.as_str().into();
        print_json(&json)
    } else {
        print(scores_text(args, &truth, &scored) + page_lines("written", written.as_slice()))
    }
}

/// Returns whether an engine's capture, of which the truth was made, has no velocity.
fn lacks_velocity(truth: &Path) -> Result<bool, Error> {
    match truth.parent() {
        Some(folder) if IngestedScene::is_in(folder) => {
            Ok(IngestedScene::read(folder)?.lacks_velocity())
        }
        _ => Ok(false),
    }
}

/// Makes the page of a picture and its truth.
fn make_page(
    args: &ScoreArgs,
    image: &Image,
    frame: &Frame,
    truth: &Truth,
    scored: &Scored,
) -> String {
    let [truth_path, frame_path] = args.truth_files();
    let named = |path: &Path, color| NamedPicture {
        name: name_file(path),
        color,
    };
    let (mean, frame) = (truth.mean().color, frame.cropped());
    let page = PicturePage {
        image: named(&args.image, image),
        reference: named(truth_path, &mean),
        frame: Some(named(frame_path, &frame.color)),
        maps: &scored.maps,
        regions: &scored.regions,
        scores: &scored.scores,
        headline: Metric::FLIP,
        missing: &missing_scores(&scored.scores),
        stops: frame.display.stops,
        notes: &scored.notes,
    };
    picture_page(&page)
}

/// Refuses a file of a different scene than the truth's.
pub fn check_scene(path: &Path, provenance: &Provenance, truth: &Truth) -> Result<(), Error> {
    let (rendered, scene) = (&provenance.scene, &truth.provenance.scene);
    if rendered == scene {
        Ok(())
    } else {
        refuse!(
            "{}: was rendered from the scene {rendered}, the truth from {scene}; render both from one",
            path.display()
        )
    }
}

/// Says how long the smear is on the scene that calibrates lengths; empty on others.
fn smear_text(smear: &Smear, truth: &Truth) -> String {
    if !shows_smears(&truth.provenance.scene) {
        return String::new();
    }
    format!(
        "smear: {:.2} of the exposure, from {:.2} to {:.2}; {}\n",
        smear.length(),
        smear.open,
        smear.close,
        smear.verdict(truth.alignment)
    )
}

fn scores_text(args: &ScoreArgs, truth: &Truth, scored: &Scored) -> Text {
    let Scored {
        scores,
        notes,
        smear,
        ..
    } = scored;
    let name = name_file(&args.image);
    let mut text = score_table(&truth.provenance.scene, &name, scores);
    text += truth_text(truth);
    if let Some(smear) = smear {
        text += smear_text(smear, truth);
    }
    for note in notes {
        text += format!("{name}: {note}\n");
    }
    for (reason, metrics) in missing_scores(scores) {
        let names: Vec<String> = metrics.iter().map(|metric| metric.name()).collect();
        let is_of_ladder = |metric| matches!(metric, Metric::Equivalent(_) | Metric::Skill(_));
        let is_lacking = args.ladder.is_none() && reason.contains("ladder");
        let way_out = if is_lacking && metrics.into_iter().any(is_of_ladder) {
            "; give one with --ladder: `run` writes it next to the truth"
        } else {
            ""
        };
        text += format!("not available: {}: {reason}{way_out}\n", names.join(", "));
    }

    text
}

/// Names the truth that a picture was compared with.
pub fn truth_text(truth: &Truth) -> String {
    let drawn = (truth.provenance.engine.as_deref()).map_or(String::new(), |engine| {
        let subframes = truth.provenance.samples_per_pixel;
        let engine = printable(engine_name(engine));
        format!("mean of {subframes} sub-frames that {engine} drew, ")
    });
    let (alignment, exposure) = (truth.alignment, truth.shutter.exposure());
    format!("\ntruth: {drawn}{alignment} shutter, open for {exposure} frames\n")
}

/// Describes what was scored as JSON.
pub fn scored_json(
    args: &ScoreArgs,
    truth: &Truth,
    notes: &[String],
    scores: impl serde::Serialize,
) -> serde_json::Value {
    serde_json::json!({
        "format": measure::FORMAT,
        "program": measure::PROGRAM,
        "image": args.image,
        "scene": truth.provenance.scene,
        "exposure": truth.shutter.exposure(),
        "alignment": truth.alignment.name(),
        "notes": notes,
        "scores": scores,
    })
}
