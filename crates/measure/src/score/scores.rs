//! Scores of a finished picture: all that its file allows.

use frame::{Frame, Image, Ladder, Picture, Truth, display_srgb, scene_linear};
use metrics::{ImageScores, MeasureError, Measured, Metric, Reference, Scores};

use super::finished_picture::FinishedPicture;
use crate::SHARP;
use crate::render::ladders::sharp_picture;
use metrics::make_oracle;

const NO_MATTES: &str = "the picture has no mattes, channels coverage.<object> that say which share of a pixel it gives \
                         to each object";
const GIVEN_MATTES: &str = "its mattes, channels coverage.<object>, were given with the picture and not measured: scores of objects judge \
                            the mattes, whatever the colours show";
const DISPLAY_REFERRED: &str = "a PNG holds nothing above display white";

/// A finished picture's scores, with notes about them.
pub struct Scored {
    /// Scores; those that the file does not allow are not applicable, with the reason.
    pub scores: Scores,
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
        let measurement = reference.measure(&Picture { color, coverage })?;
        Ok(measurement.scores)
    };
    let mut scores = measure(finished.color.clone())?;
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
        if let Some(flip) = rounded.moving.flip.value() {
            notes.push(format!(
                "the truth itself, as a PNG of 8 bits, would have a flip_moving of {flip:.3}"
            ));
        }
    }
    Ok(Scored { scores, notes })
}

/// Rounds the image as an 8-bit PNG does.
fn round_to_8_bits(image: &Image, stops: f32) -> Image {
    let displayed = display_srgb(image, stops);
    let steps = displayed.map(|pixel| pixel.map(|value| (value * 255.0).round() / 255.0));
    scene_linear(&steps, stops)
}

/// Lists the scores that do not apply by reason, each list in the order of a report.
pub fn missing_scores(scores: &Scores) -> Vec<(String, Vec<Metric>)> {
    let mut missing: Vec<(String, Vec<Metric>)> = Vec::new();
    for metric in Metric::all() {
        let Measured::NotApplicable { reason } = scores.get(metric) else {
            continue;
        };
        match missing.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, metrics)) => metrics.push(metric),
            None => missing.push((reason, vec![metric])),
        }
    }
    missing
}

/// Removes HDR-FLIP, which uses exposures where display white is dark.
fn take_out_flip_hdr(scores: &mut ImageScores) {
    scores.flip_hdr = Measured::not_applicable(DISPLAY_REFERRED);
}
