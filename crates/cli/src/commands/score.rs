//! The command `score`.

use frame::{Frame, Ladder, Truth};
use metrics::Metric;
use store::printable;
use suite::{Error, Scored, engine_name, missing_scores, read_finished_picture, score};

use super::convention::read_convention;
use super::score_sequence;
use super::scored::{ScoreArgs, scored_json};
use crate::output::{print, print_json};
use crate::tables::score_table;

/// Scores one finished picture, or a sequence of them, and prints the scores, and those that its file does not allow.
pub fn execute(args: &ScoreArgs) -> Result<(), Error> {
    if args.frames > 1 {
        return score_sequence::execute(args);
    }
    let truth = Truth::read(&args.truth)?;
    let frame = Frame::read(&args.frame)?;
    let ladder = args.ladder.as_deref().map(Ladder::read).transpose()?;
    check_scenes(args, &truth, &frame, ladder.as_ref())?;
    let convention = read_convention(args.convention.as_deref())?;
    let picture = read_finished_picture(&args.image, &convention, &frame, &truth)?;
    let scored = score(&picture, &frame, &truth, ladder.as_ref())
        .map_err(|error| Error::Usage(format!("{}: {error}", args.image.display())))?;
    if args.json {
        let mut json = scored_json(args, &truth, &scored.notes, &scored.scores);
        json["truth_hash"] = truth.provenance.content_hash.as_str().into();
        print_json(&json)
    } else {
        print(&scores_text(args, &truth, &scored))
    }
}

/// Refuses files of different scenes.
fn check_scenes(
    args: &ScoreArgs,
    truth: &Truth,
    frame: &Frame,
    ladder: Option<&Ladder>,
) -> Result<(), Error> {
    let frame = (&args.frame, &frame.provenance.scene);
    let ladder = (args.ladder.iter()).zip(ladder.map(|ladder| &ladder.provenance.scene));
    for (path, scene) in std::iter::once(frame).chain(ladder) {
        let truth_scene = &truth.provenance.scene;
        if scene != truth_scene {
            refuse!(
                "{}: was rendered from the scene {scene}, the truth from {truth_scene}; render both from one",
                path.display()
            );
        }
    }
    Ok(())
}

fn scores_text(args: &ScoreArgs, truth: &Truth, Scored { scores, notes }: &Scored) -> String {
    let name = args.image.file_name().unwrap_or(args.image.as_os_str());
    let name = name.to_string_lossy();
    let name = printable(&name);
    let mut text = score_table(&truth.provenance.scene, &name, scores);
    let drawn = (truth.provenance.engine.as_deref()).map_or(String::new(), |engine| {
        let subframes = truth.provenance.samples_per_pixel;
        format!(
            "mean of {subframes} sub-frames that {} drew, ",
            printable(engine_name(engine))
        )
    });
    text += &format!(
        "\ntruth: {drawn}{} shutter, open for {} frames\n",
        truth.alignment,
        truth.shutter.exposure()
    );
    for note in notes {
        text += &format!("{name}: {note}\n");
    }
    for (reason, metrics) in missing_scores(scores) {
        let names: Vec<String> = metrics.iter().map(|metric| metric.name()).collect();
        let way_out = match args.ladder {
            None if names_ladder(&metrics) && reason.contains("ladder") => {
                "; give one with --ladder: `run` writes it beside the truth"
            }
            _ => "",
        };
        text += &format!("not available: {}: {reason}{way_out}\n", names.join(", "));
    }
    text
}

/// Tells whether any of the scores needs a ladder.
fn names_ladder(metrics: &[Metric]) -> bool {
    (metrics.iter()).any(|metric| matches!(metric, Metric::Equivalent(_) | Metric::Skill(_)))
}
