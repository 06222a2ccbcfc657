//! The command `score` for a sequence of pictures.

use frame::{Frame, Image, Truth};
use measure::{
    Error, Frames, SequenceTruth, file_at_frame, find_numbered, printable, printable_path,
    read_convention, read_finished_picture, score_sequence, worst_frames,
};
use metrics::{Measured, SequenceMeasurement, SequenceMetric};
use scene::Scene;
use terminal::refuse;

use crate::args::ScoreArgs;
use crate::picture::{check_scene, scored_json, truth_text};
use run::score_sequence_table;
use terminal::output::{Text, print, print_json};
use terminal::selection::select_scenes;

/// Scores the numbered pictures of a folder, and prints their scores over time.
pub fn execute(args: &ScoreArgs) -> Result<(), Error> {
    let files = find_numbered(&args.image, args.frames)?;
    let mut truths = vec![read_truth(args, 0)?];
    let scene = load_scene(args, &truths[0])?;
    for frame in 1..args.frames {
        truths.push(read_truth(args, frame)?);
    }
    let convention = read_convention(args.convention.as_deref())?;
    let mut notes: Vec<String> = Vec::new();
    let mut pictures: Vec<Image> = Vec::new();
    for (file, truth) in files.iter().zip(&truths) {
        let picture = read_finished_picture(file, &convention, &truth.frame, &truth.truth)?;
        notes.extend(picture.notes);
        pictures.push(picture.color);
    }
    notes.sort();
    notes.dedup();
    let frames = Frames {
        count: args.frames,
        per_second: args.fps,
    };
    let per_second = frames.shown(&scene.id);
    let scored = score_sequence(&pictures, &scene, &truths, per_second)?;
    if args.json {
        print_json(&scores_json(args, per_second, &truths, &scored, &notes))
    } else {
        print(scores_text(args, &truths[0].truth, &scored, &notes))
    }
}

/// Reads the frame and the truth of one frame of the sequence.
fn read_truth(args: &ScoreArgs, frame: u32) -> Result<SequenceTruth, Error> {
    let [path, frame_path] = args.truth_files().map(|first| file_at_frame(first, frame));
    let truth = Truth::read(&path)?;
    let frame = Frame::read(&frame_path)?;
    check_scene(&frame_path, &frame.provenance, &truth)?;
    Ok(SequenceTruth { frame, truth, path })
}

/// Loads the scene of the first truth.
fn load_scene(args: &ScoreArgs, first: &SequenceTruth) -> Result<Scene, Error> {
    let provenance = &first.truth.provenance;
    let name = printable(&provenance.scene).into_owned();
    let refuse = |reason: &str| {
        let path = printable_path(&first.path);
        refuse!("{path}: {reason}")
    };
    if provenance.engine.is_some() {
        return refuse("an engine drew it, which makes one frame; leave --frames out");
    }
    if name.contains('/') {
        return refuse(&format!(
            "is the truth of a later frame, {name}; name that of the first frame"
        ));
    }
    let choices = select_scenes(args.root.scenes_dir.clone(), std::slice::from_ref(&name));
    let mut choices = choices.map_err(|error| {
        Error::Refused(format!(
            "{}: is of the scene {name}, whose motion the scores of a sequence follow; name the folder that holds it with \
             --scenes-dir: {error}",
            printable_path(&first.path)
        ))
    })?;
    match choices.len() {
        1 => Ok(choices.remove(0).scene),
        _ => refuse(&format!("its scene {name} is no name of one scene")),
    }
}

fn scores_text(
    args: &ScoreArgs,
    truth: &Truth,
    scored: &SequenceMeasurement,
    notes: &[String],
) -> Text {
    let name = printable_path(&args.image);
    let mut text =
        score_sequence_table(&truth.provenance.scene, &name, args.frames, &scored.scores);
    text += truth_text(truth);
    let worst: Vec<String> = (worst_frames(scored).iter())
        .map(|(metric, frame)| format!("{metric} {frame}"))
        .collect();
    text += format!("worst frames: {}\n", worst.join(", "));
    for note in notes {
        text += format!("{name}: {note}\n");
    }
    for metric in SequenceMetric::ALL {
        if let Measured::NotApplicable { reason } = scored.scores.get(metric) {
            text += format!("not available: {}: {reason}\n", metric.row().name);
        }
    }
    text
}

fn scores_json(
    args: &ScoreArgs,
    per_second: f64,
    truths: &[SequenceTruth],
    scored: &SequenceMeasurement,
    notes: &[String],
) -> serde_json::Value {
    let first = &truths[0].truth;
    let frames = truths.iter().zip(&scored.errors).zip(&scored.flickers);
    let frames = frames.map(|((truth, error), flicker)| {
        serde_json::json!({
            "truth_hash": truth.truth.provenance.content_hash,
            "error": error,
            "flicker": flicker,
        })
    });
    let mut json = scored_json(args, first, notes, &scored.scores);
    json["per_second"] = per_second.into();
    json["worst_frames"] = serde_json::json!(worst_frames(scored));
    json["frames"] = frames.collect();
    json
}
