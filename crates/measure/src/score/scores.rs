//! Scores of a finished picture: all that its file allows.

use frame::{Frame, Image, Ladder, Picture, Truth, display_srgb, scene_linear};
use metrics::{
    ImageMetric, ImageScores, Maps, MeasureError, Measured, Measurement, Metric, Reference,
    Regions, Scores, Smear, measure_smear,
};

use super::finished_picture::FinishedPicture;
use crate::SHARP;
use crate::render::ladders::sharp_picture;
use metrics::make_oracle;

const NO_MATTES: &str = "the picture has no mattes, channels coverage.<object> that say which share of a pixel it gives \
                         to each object";
const GIVEN_MATTES: &str = "its mattes, channels coverage.<object>, were given with the picture and not measured: scores of objects judge \
                            the mattes, whatever the colours show";
const DISPLAY_REFERRED: &str = "a picture of a display holds nothing above display white";

/// A finished picture's scores, with notes about them.
pub struct Scored {
    /// Scores; those that the file does not allow are not applicable, with the reason.
    pub scores: Scores,
    /// Maps of its errors.
    pub maps: Maps,
    /// Regions that scores are pooled over.
    pub regions: Regions,
    /// Smear of the only object that moves; none if there is no such object.
    pub smear: Option<Smear>,
    /// Notes, each a sentence.
    pub notes: Vec<String>,
}

/// Scores a finished picture against the truth, at the frame's exposures.
pub fn score(
    finished: &FinishedPicture,
    frame: &Frame,
    truth: &Truth,
    ladder: Option<&Ladder>,
) -> Result<Scored, MeasureError> {
    let oracle = make_oracle(frame, truth);
    let frame = frame.cropped();
    let mut reference = Reference::new(&frame, truth, ladder, &frame.display.into())?;
    let sharp = || {
        let mut rungs = ladder.iter().flat_map(|ladder| &ladder.rungs);
        rungs
            .find(|rung| rung.subframes == SHARP)
            .cloned()
            .ok_or(())
    };
    if let Ok(sharp) = sharp_picture(&frame, truth, sharp) {
        reference = reference.with_ends(&sharp, &oracle)?;
    }
    // Colour scores ignore mattes, and matte scores are removed below.
    let mattes = finished.mattes.as_ref().unwrap_or(&frame.coverage);
    let measure = |color: Image| {
        let coverage = mattes.clone();
        reference.measure(&Picture { color, coverage })
    };
    let Measurement {
        mut scores, maps, ..
    } = measure(finished.color.clone())?;
    let mut notes = finished.notes.clone();
    match finished.mattes {
        Some(_) => notes.push(GIVEN_MATTES.to_owned()),
        None => scores.take_out_mattes(NO_MATTES),
    }
    if finished.display_referred {
        for region in [
            &mut scores.moving,
            &mut scores.support,
            &mut scores.still,
            &mut scores.full,
            &mut scores.knowable,
            &mut scores.unknowable,
        ] {
            take_out_flip_hdr(region);
        }
        let rounded = measure(round_to_8_bits(&truth.mean().color, frame.display.stops))?;
        if let Some(flip) = rounded.scores.moving.flip.value() {
            notes.push(format!(
                "the truth itself, as a PNG of 8 bits, would have a flip_moving of {flip:.3}"
            ));
        }
    }
    Ok(Scored {
        scores,
        maps,
        smear: measure_smear(&frame, &finished.color),
        regions: reference.regions,
        notes,
    })
}

/// Rounds the image as an 8-bit PNG does.
fn round_to_8_bits(image: &Image, stops: f32) -> Image {
    let displayed = display_srgb(image, stops);
    let steps = displayed.map(|pixel| pixel.map(|value| (value * 255.0).round() / 255.0));
    scene_linear(&steps, stops)
}

/// Lists the scores that do not apply by reason, each list in the order of a report.
pub fn missing_scores(scores: &Scores) -> Vec<(String, Vec<Metric>)> {
    let reasons = Metric::all()
        .into_iter()
        .filter_map(|metric| match scores.get(metric) {
            Measured::NotApplicable { reason } => Some((metric, reason)),
            Measured::Score(_) => None,
        });
    group_by_reason(reasons)
}

/// Collects metrics with equal reasons, in their order.
pub fn group_by_reason(
    reasons: impl IntoIterator<Item = (Metric, String)>,
) -> Vec<(String, Vec<Metric>)> {
    let mut missing: Vec<(String, Vec<Metric>)> = Vec::new();
    for (metric, reason) in reasons {
        match missing.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, metrics)) => metrics.push(metric),
            None => missing.push((reason, vec![metric])),
        }
    }
    missing
}

/// Names metrics. All errors of colour over a region have one name: `*_moving`.
pub fn shorten_names(metrics: &[Metric]) -> Vec<String> {
    let of = |region| ImageMetric::ALL.map(|error| Metric::Image(error, region));
    let mut names: Vec<String> = Vec::new();
    for metric in metrics {
        let name = match metric {
            Metric::Image(_, region) if of(*region).iter().all(|one| metrics.contains(one)) => {
                format!("*_{region}")
            }
            _ => metric.name(),
        };
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Removes HDR-FLIP, which uses exposures where display white is dark.
fn take_out_flip_hdr(scores: &mut ImageScores) {
    scores.flip_hdr = Measured::not_applicable(DISPLAY_REFERRED);
}
