//! The scores of a finished picture: all that its file allows.

use frame::{Frame, Ladder, Picture, Truth};
use metrics::{
    Equivalent, ImageScores, LabelScores, MeasureError, Measured, Metric, ObjectScores, Reference,
    Scores,
};

use crate::finished::Finished;

const NO_MATTES: &str = "the picture has no mattes, channels coverage.<object> that say which share of a pixel it gives \
                         to each object";
const SHOWN: &str = "a PNG holds nothing above display white";

/// Scores a finished picture against the truth, viewed as the frame says. What its file does not allow is not
/// applicable, with the reason.
pub fn score(
    finished: &Finished,
    frame: &Frame,
    truth: &Truth,
    ladder: Option<&Ladder>,
) -> Result<Scores, MeasureError> {
    let frame = frame.cropped();
    let reference = Reference::new(&frame, truth, ladder, &frame.display.into())?;
    let picture = Picture {
        color: finished.color.clone(),
        // No colour's score looks at mattes, and those of mattes are taken out below.
        coverage: (finished.mattes.clone()).unwrap_or_else(|| frame.coverage.clone()),
    };
    let mut scores = reference.measure(&picture)?.scores;
    if finished.mattes.is_none() {
        take_out_mattes(&mut scores);
    }
    if finished.shown {
        for region in [&mut scores.moving, &mut scores.still, &mut scores.full] {
            take_out_brightness(region);
        }
    }
    Ok(scores)
}

/// Which scores do not apply, by their reasons, each in the order of a report.
pub fn missing(scores: &Scores) -> Vec<(String, Vec<Metric>)> {
    let mut missing: Vec<(String, Vec<Metric>)> = Vec::new();
    for metric in Metric::all() {
        let Measured::NotApplicable { reason } = scores.get(metric) else {
            continue;
        };
        // Objects give their reasons one by one.
        let reason = match reason.contains(NO_MATTES) {
            true => NO_MATTES.to_owned(),
            false => reason,
        };
        match missing.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, metrics)) => metrics.push(metric),
            None => missing.push((reason, vec![metric])),
        }
    }
    missing
}

fn take_out_mattes(scores: &mut Scores) {
    let none = || Measured::not_applicable(NO_MATTES);
    scores.label_total_variation = LabelScores {
        mean: none(),
        p95: none(),
    };
    scores.equivalent_subframes.label_total_variation = Equivalent::NotApplicable {
        reason: NO_MATTES.to_owned(),
    };
    for scores in &mut scores.objects {
        *scores = ObjectScores {
            object: scores.object.clone(),
            moves: scores.moves,
            displacement: scores.displacement,
            bleed_lateral: none(),
            bleed_leading: none(),
            bleed_trailing: none(),
            lateral_growth: none(),
            lateral_shrink: none(),
            misplacement: none(),
            centroid: none(),
            extent: none(),
            hole: none(),
            deficit: none(),
            energy: none(),
            label_total_variation: none(),
        };
    }
}

/// HDR-FLIP looks at exposures at which display white is dark.
fn take_out_brightness(scores: &mut ImageScores) {
    scores.flip_hdr = Measured::not_applicable(SHOWN);
}
