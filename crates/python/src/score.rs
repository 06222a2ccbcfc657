//! Scores of pictures.

use frame::Display;
use measure::{
    FinishedPicture, PicturePair, Scored, compare_pictures, missing_scores, score as score_finished,
};
use metrics::{Metric, Scores};
use numpy::PyReadonlyArray3;
use pyo3::prelude::*;

use crate::arrays::take_image;
use crate::render::Render;
use crate::work::work;

const NEEDS_TRUTH: &str =
    "it needs to know what moves: score against a render, score(image, truth)";

/// Scores by name, the others' reasons by name, and notes.
type Named = (Vec<(String, f64)>, Vec<(String, String)>, Vec<String>);

/// Scores a picture of a rendered frame against its truth.
#[pyfunction]
pub fn score(py: Python, image: PyReadonlyArray3<f32>, render: &Render) -> PyResult<Named> {
    let finished = FinishedPicture {
        color: take_image(&image)?,
        mattes: None,
        display_referred: false,
        notes: Vec::new(),
    };
    let rendered = &render.scene;
    work(py, || {
        let Scored { scores, notes, .. } = score_finished(
            &finished,
            &rendered.frame.frame,
            &rendered.truth,
            rendered.sharp.as_ref(),
        )?;
        let missing = missing_scores(&scores);
        Ok(name_scores(&scores, missing, notes))
    })
}

/// Scores a picture against another of the same size: what the two alone tell.
#[pyfunction]
pub fn score_pair(
    py: Python,
    image: PyReadonlyArray3<f32>,
    reference: PyReadonlyArray3<f32>,
) -> PyResult<Named> {
    let (image, reference) = (take_image(&image)?, take_image(&reference)?);
    work(py, || {
        let compared = compare_pictures(&PicturePair {
            reference: &reference,
            image: &image,
            frame: None,
            moving: None,
            mattes: None,
            display: Display::default(),
            display_referred: false,
        })?;
        let scores = &compared.measurement.scores;
        let missing = (Metric::all().into_iter())
            .filter(|metric| scores.get(*metric).value().is_none())
            .collect();
        let reasons = vec![(NEEDS_TRUTH.to_owned(), missing)];
        Ok(name_scores(scores, reasons, Vec::new()))
    })
}

fn name_scores(scores: &Scores, missing: Vec<(String, Vec<Metric>)>, notes: Vec<String>) -> Named {
    let values = Metric::all().into_iter();
    let values = values
        .filter_map(|metric| Some((metric.name(), scores.get(metric).value()?)))
        .collect();
    let reasons = missing.into_iter().flat_map(|(reason, metrics)| {
        (metrics.into_iter()).map(move |metric| (metric.name(), reason.clone()))
    });
    (values, reasons.collect(), notes)
}
