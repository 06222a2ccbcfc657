//! Scores of pictures.

use measure::{FinishedPicture, Scored, missing_scores, score as score_finished};
use metrics::{Metric, Scores};
use numpy::PyReadonlyArray3;
use pyo3::prelude::*;

use crate::arrays::take_image;
use crate::render::Render;
use crate::work::work;

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
        let Scored { scores, notes } = score_finished(
            &finished,
            &rendered.frame.frame,
            &rendered.truth,
            rendered.sharp.as_ref(),
        )?;
        let missing = missing_scores(&scores);
        Ok(name_scores(&scores, missing, notes))
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
