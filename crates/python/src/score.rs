//! Scores of pictures.

use frame::Display;
use measure::{FinishedPicture, Scored, missing_scores, score as score_finished};
use metrics::{ImageMetric, Metric, Region, Scores, flip_ldr, psnr};
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

/// Scores a picture against another of the same size: what the two alone tell.
#[pyfunction]
pub fn score_pair(
    py: Python,
    image: PyReadonlyArray3<f32>,
    reference: PyReadonlyArray3<f32>,
) -> PyResult<Named> {
    let (image, reference) = (take_image(&image)?, take_image(&reference)?);
    work(py, || {
        let flip = flip_ldr(&reference, &image, &Display::default().into());
        let flip = flip.pixels.iter().map(|error| f64::from(*error));
        let values = image.pixels.as_flattened().iter();
        let pairs = values.zip(reference.pixels.as_flattened());
        let squared = mean(pairs.map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2)));
        let scores = [
            (ImageMetric::Flip, mean(flip)),
            (ImageMetric::Mse, squared),
            (ImageMetric::Psnr, psnr(squared, 0.0)),
        ];
        let scores = scores.map(|(metric, value)| (Metric::Image(metric, Region::Full), value));
        let others = Metric::all().into_iter();
        let others = others.filter(|metric| scores.iter().all(|(known, _)| known != metric));
        Ok((
            scores.map(|(metric, value)| (metric.name(), value)).into(),
            others
                .map(|metric| (metric.name(), NEEDS_TRUTH.to_owned()))
                .collect(),
            Vec::new(),
        ))
    })
}

/// Averages numbers, of which there are some.
fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
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
