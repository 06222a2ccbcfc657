//! The command `score`.

use std::path::{Path, PathBuf};
use terminal::refuse;

use clap::Args;
use frame::{Frame, Ladder, Provenance, Truth};
use measure::{
    Error, Frames, Scored, engine_name, missing_scores, printable, read_finished_picture, score,
};
use metrics::Metric;

use super::convention::read_convention;
use run::score_table;
use terminal::arguments::{RootArgs, above_zero, frame_count};
use terminal::output::{print, print_json};

#[derive(Debug, Args)]
pub struct ScoreArgs {
    /// The truth: truth_<alignment>.exr of `truths render` or `run`; for a sequence, the first
    /// frame's.
    #[arg(long, value_name = "FILE")]
    pub truth: PathBuf,
    /// The frame that the picture was made from: frame.exr of the same scene; for a sequence, the
    /// first one.
    #[arg(long, value_name = "FILE")]
    pub frame: PathBuf,
    /// The picture: OpenEXR with scene-linear R G B and optional coverage.<object>; or a PNG for
    /// display. With --frames a folder of such pictures, 0000.exr, 0001.exr and so on.
    #[arg(long, value_name = "FILE|DIR")]
    pub image: PathBuf,
    /// TOML file with a table [convention] that says which colour the picture has [default:
    /// scene-linear].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// The folder ladder_<alignment> of `run` [default: no equivalent sub-frames, and no skill
    /// unless the shutter is centred].
    #[arg(long, value_name = "FOLDER")]
    pub ladder: Option<PathBuf>,
    /// Score a sequence of N consecutive frames, with files as `run` and `truths render` write
    /// them.
    #[arg(help_heading = "Sequences", long, value_name = "N", default_value_t = 1, value_parser = frame_count(), conflicts_with = "ladder")]
    pub frames: u32,
    /// Frames per second at which the sequence is shown. It changes only the score JOD. A scene at
    /// a frame rate is shown at that rate.
    #[arg(help_heading = "Sequences", long, value_name = "F", default_value_t = Frames::default().per_second, value_parser = above_zero(1000.0))]
    pub fps: f64,
    #[command(flatten, next_help_heading = "Sequences")]
    pub root: RootArgs,
    /// Print all scores as JSON instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Scores one finished picture; prints the scores, and those that its file does not allow.
pub fn execute(args: &ScoreArgs) -> Result<(), Error> {
    let truth = Truth::read(&args.truth)?;
    let frame = Frame::read(&args.frame)?;
    let ladder = args.ladder.as_deref().map(Ladder::read).transpose()?;
    check_scene(&args.frame, &frame.provenance, &truth)?;
    if let (Some(path), Some(ladder)) = (&args.ladder, &ladder) {
        check_scene(path, &ladder.provenance, &truth)?;
    }
    let convention = read_convention(args.convention.as_deref())?;
    let picture = read_finished_picture(&args.image, &convention, &frame, &truth)?;
    let scored = score(&picture, &frame, &truth, ladder.as_ref())
        .map_err(|error| Error::Refused(format!("{}: {error}", args.image.display())))?;
    if args.json {
        let mut json = scored_json(args, &truth, &scored.notes, &scored.scores);
        json["truth_hash"] = truth.provenance.content_hash.as_str().into();
        print_json(&json)
    } else {
        print(&scores_text(args, &truth, &scored))
    }
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

fn scores_text(args: &ScoreArgs, truth: &Truth, Scored { scores, notes }: &Scored) -> String {
    let name = args.image.file_name().unwrap_or(args.image.as_os_str());
    let name = name.to_string_lossy();
    let name = printable(&name);
    let mut text = score_table(&truth.provenance.scene, &name, scores);
    text += &truth_text(truth);
    for note in notes {
        text += &format!("{name}: {note}\n");
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
        text += &format!("not available: {}: {reason}{way_out}\n", names.join(", "));
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
