//! Scores from pooled errors and the noise in them.

use crate::color::cross_error::psnr;
use crate::color::pooled::Pooled;
use crate::{ImageScores, LabelScores, Measured};

/// A picture's errors over a region and those of the truth's noise, or why there are none.
pub type Found = Result<(Pooled, Pooled), &'static str>;

fn score(found: &Found, error: impl Fn(&Pooled) -> f64) -> Measured {
    match found {
        Ok((own, noise)) => Measured::score(error(own), error(noise)),
        Err(reason) => Measured::not_applicable(*reason),
    }
}

/// Errors of colour.
pub fn image_scores(found: &Found) -> ImageScores {
    let score = |error: fn(&Pooled) -> f64| score(found, error);
    ImageScores {
        mse: score(|pooled| pooled.mse),
        psnr: psnr_score(found),
        relmse: score(|pooled| pooled.relmse),
        mae: score(|pooled| pooled.mae),
        smape: score(|pooled| pooled.smape),
        flip: score(|pooled| pooled.flip),
        flip_weighted_median: score(|pooled| pooled.flip_weighted_median),
        flip_p95: score(|pooled| pooled.flip_p95),
        flip_p99: score(|pooled| pooled.flip_p99),
        flip_hdr: score(|pooled| pooled.flip_hdr),
        ssim: ssim_score(found),
    }
}

/// An error below its noise counts as the noise.
fn psnr_score(found: &Found) -> Measured {
    match found {
        Ok((own, noise)) => Measured::score(psnr(own.mse, noise.mse), psnr(noise.mse, noise.mse)),
        Err(reason) => Measured::not_applicable(*reason),
    }
}

/// Windows that reach beyond the picture are left out.
fn ssim_score(found: &Found) -> Measured {
    let windows = |(own, noise): &(Pooled, Pooled)| Some((own.ssim?, noise.ssim?));
    match found.as_ref().map(windows) {
        Ok(Some((own, noise))) => Measured::score(own, noise),
        Ok(None) => Measured::not_applicable("no window of the region lies within the picture"),
        Err(reason) => Measured::not_applicable(*reason),
    }
}

/// Errors of labels.
pub fn label_scores(found: &Found) -> LabelScores {
    LabelScores {
        mean: score(found, |pooled| pooled.label),
        p95: score(found, |pooled| pooled.label_p95),
    }
}
