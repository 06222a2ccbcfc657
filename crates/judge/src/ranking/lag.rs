//! Lag: the error of a frame that is not the middle of its shutter.

use frame::Alignment;
use measure::{Case, ReferencePicture};
use metrics::Metric;

use crate::ranking::filters::list_summarized;

/// Returns the frame's excess FLIP over a sharp picture of the shutter's middle: the mean over the
/// scenes of `cases`, which share one shutter and frame rate. None if the frame is that picture.
pub fn mean_lag(cases: &[&Case]) -> Option<f64> {
    let lags = cases.iter().filter(|case| case.is_sharp()).map(|sharp| {
        let is_frame = |case: &&&Case| {
            case.reference() == Some(ReferencePicture::Identity) && case.scene == sharp.scene
        };
        let frame = cases.iter().find(is_frame)?;
        Some(frame.estimate(Metric::FLIP)? - sharp.estimate(Metric::FLIP)?)
    });
    let lags: Vec<f64> = lags.flatten().collect();
    (!lags.is_empty()).then(|| lags.iter().sum::<f64>() / lags.len() as f64)
}

/// Describes the cost of lag under each shutter; none if no shutter has one.
pub fn lag_text(cases: &[Case]) -> Option<String> {
    let cases = list_summarized(cases);
    let mut alignments: Vec<Alignment> = cases.iter().map(|case| case.alignment).collect();
    alignments.sort_unstable();
    alignments.dedup();
    let lags = alignments.into_iter().filter_map(|alignment| {
        let group = cases.iter().filter(|case| case.alignment == alignment);
        let lag = mean_lag(&group.copied().collect::<Vec<_>>())?;
        let number = Metric::FLIP.number(lag);
        Some(format!("{number} under a {alignment} shutter"))
    });
    let lags: Vec<String> = lags.collect();
    (!lags.is_empty()).then(|| {
        format!(
            "Lag behind the frame, identity less accumulate:1: FLIP {}.",
            lags.join(", ")
        )
    })
}
