//! Scores of pooled errors and the noise in them.

use crate::color::cross_error::psnr;
use crate::color::grain::grain;
use crate::picture::pooled::Pooled;
use crate::{ImageScores, LabelScores, Measured};

/// Errors of a picture and of the truth's noise over a region, or the reason why there are none.
pub type Found = Result<(Pooled, Pooled), &'static str>;

fn score(found: &Found, error: impl Fn(&Pooled) -> f64) -> Measured {
    match found {
        Ok((own, noise)) => Measured::score(error(own), error(noise)),
        Err(reason) => Measured::not_applicable(*reason),
    }
}

/// Scores the errors of colour.
pub fn score_image(found: &Found) -> ImageScores {
    // An error below its noise counts as the noise.
    let (mse, squared_grain) = found.map_or((0.0, 0.0), |(_, noise)| (noise.mse, noise.grain));
    ImageScores {
        mse: score(found, |pooled| pooled.mse),
        psnr: score(found, |pooled| psnr(pooled.mse, mse)),
        relmse: score(found, |pooled| pooled.relmse),
        mae: score(found, |pooled| pooled.mae),
        smape: score(found, |pooled| pooled.smape),
        flip: score(found, |pooled| pooled.flip),
        flip_weighted_median: score(found, |pooled| pooled.flip_weighted_median),
        flip_p95: score(found, |pooled| pooled.flip_p95),
        flip_p99: score(found, |pooled| pooled.flip_p99),
        flip_hdr: score(found, |pooled| pooled.flip_hdr),
        ssim: score_ssim(found),
        grain: score(found, |pooled| grain(pooled.grain, squared_grain)),
    }
}

/// Scores SSIM, without windows that extend beyond the picture.
fn score_ssim(found: &Found) -> Measured {
    let reason = "no window of the region is within the picture";
    match found {
        Ok((own, noise)) => Measured::of(own.ssim, noise.ssim, reason),
        Err(reason) => Measured::not_applicable(*reason),
    }
}

/// Scores the errors of labels.
pub fn score_labels(found: &Found) -> LabelScores {
    LabelScores {
        mean: score(found, |pooled| pooled.label),
        p95: score(found, |pooled| pooled.label_p95),
    }
}
