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
    let mse = found.map_or(0.0, |(_, noise)| noise.mse);
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
        grain: score(found, |pooled| grain(pooled.grain)),
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes pooled errors that all differ.
    fn pooled(mse: f64) -> Pooled {
        Pooled {
            mse,
            relmse: 0.2,
            mae: 0.3,
            smape: 0.4,
            flip: 0.5,
            flip_weighted_median: 0.6,
            flip_p95: 0.7,
            flip_p99: 0.8,
            flip_hdr: 0.9,
            ssim: None,
            label: 1.1,
            label_p95: 1.2,
            grain: 1.3,
        }
    }

    #[test]
    fn each_score_is_the_error_of_its_name() {
        let found = Ok((pooled(0.1), pooled(0.01)));
        let own = score_image(&found);
        let scores = [
            (own.mse, 0.1),
            (own.psnr, 10.0),
            (own.relmse, 0.2),
            (own.mae, 0.3),
            (own.smape, 0.4),
            (own.flip, 0.5),
            (own.flip_weighted_median, 0.6),
            (own.flip_p95, 0.7),
            (own.flip_p99, 0.8),
            (own.flip_hdr, 0.9),
        ];
        for (measured, expected) in scores {
            assert_eq!(measured.value(), Some(expected));
        }
        assert_eq!(own.ssim.value(), None);
        let labels = score_labels(&found);
        assert_eq!(
            [labels.mean, labels.p95].map(|own| own.value()),
            [Some(1.1), Some(1.2)]
        );
    }

    #[test]
    fn psnr_is_at_most_that_of_the_noise() {
        let psnr = |mse| score_image(&Ok((pooled(mse), pooled(0.01)))).psnr;
        assert_eq!(psnr(0.001), Measured::score(20.0, 20.0));
        assert_eq!(psnr(-0.001), Measured::score(20.0, 20.0));
        assert_eq!(psnr(0.1), Measured::score(10.0, 20.0));
    }
}
