//! Agreement of noisy pixels with known values.

use frame::{Size, Truth};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Rounding of colours to f32, and of the vertices of meshes.
const ROUNDING: f64 = 2e-6;

/// An estimate, its standard error, and its expected value.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// Rendered value.
    pub value: f64,
    /// Standard error, from the spread of replicates.
    pub error: f64,
    /// Least standard error that a pixel is given.
    pub floor: f64,
    /// Value of the closed form.
    pub expected: f64,
}

/// Compares the first colour component of every pixel with the `expected` one at its column and
/// row.
pub fn estimate_pixels(truth: &Truth, expected: impl Fn(u32, u32) -> f64) -> Vec<Estimate> {
    let Size { width, height } = truth.size();
    let color = truth.mean().color;
    (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .map(|(x, y)| Estimate {
            value: f64::from(color.at(x, y)[0]),
            error: f64::from(truth.standard_error.at(x, y)[0]),
            floor: 0.0,
            expected: expected(x, y),
        })
        .collect()
}

/// Compares white things on black, where colour counts samples.
///
/// Eight replicates of n samples may agree on a count although each is off by one sample with a
/// probability of 0.3 (they do in 0.7^8 = 6 % of cases); the error of their mean is then sqrt(0.3 x
/// 0.7 / 8) / n, and not the zero of their spread. Pixels that are expected to be exactly empty or
/// full get no such allowance.
pub fn coverage_estimates(truth: &Truth, expected: impl Fn(u32, u32) -> f64) -> Vec<Estimate> {
    let samples = truth.provenance.samples_per_pixel / truth.provenance.replicates;
    let replicates = f64::from(truth.provenance.replicates);
    let floor = (0.3 * 0.7 / replicates).sqrt() / f64::from(samples);
    let mut estimates = estimate_pixels(truth, expected);
    let partial = |estimate: &&mut Estimate| estimate.expected > 0.0 && estimate.expected < 1.0;
    (estimates.iter_mut().filter(partial)).for_each(|estimate| estimate.floor = floor);
    estimates
}

/// Fails unless the estimates of `replicates` replicates agree with the expected values: pixel by
/// pixel, and in total.
///
/// The pixel test is that of Mitsuba 3's render tests with Student's distribution in place of the
/// normal one: at least 99.75 % of the pixels must have a p-value above Sidak's 1 -
/// 0.99^(1/pixels). 99.75 % must also lie within four standard errors of a normal distribution (p =
/// 6.3e-5). Errors that all pixels share show in the sum.
pub fn expect_agreement(what: &str, estimates: &[Estimate], replicates: u32) {
    let student = StudentsT::new(0.0, 1.0, f64::from(replicates - 1)).expect("degrees of freedom");
    let count = estimates.len() as f64;
    let sidak = 1.0 - 0.99_f64.powf(1.0 / count);
    let p_value = |estimate: &Estimate| {
        let off = (estimate.value - estimate.expected).abs() - ROUNDING;
        match estimate.error.max(estimate.floor) {
            _ if off <= 0.0 => 1.0,
            0.0 => 0.0,
            error => 2.0 * student.sf(off / error),
        }
    };
    for (name, least) in [("Sidak's level", sidak), ("four standard errors", 6.3e-5)] {
        let outside = estimates
            .iter()
            .filter(|estimate| p_value(estimate) < least);
        let outside: Vec<&Estimate> = outside.collect();
        assert!(
            outside.len() as f64 <= 0.0025 * count,
            "{what}: {} of {count} pixels are outside {name}, first {:?}",
            outside.len(),
            outside[0],
        );
    }
    expect_total(what, estimates, |_| 1.0);
}

/// Fails unless the sum of all estimates, each times the weight of its index, agrees with the
/// expected one. This finds errors that all pixels share and, with weights that grow across the
/// picture, shifts.
pub fn expect_total(what: &str, estimates: &[Estimate], weight: impl Fn(usize) -> f64) {
    let (mut sum, mut variance, mut rounding) = (0.0, 0.0, 0.0);
    for (index, estimate) in estimates.iter().enumerate() {
        let factor = weight(index);
        sum += factor * (estimate.value - estimate.expected);
        variance += (factor * estimate.error).powi(2);
        rounding += factor.abs() * ROUNDING;
    }
    let error = variance.sqrt();
    // Pixels are independent, so their sum is nearly normal: 4.5 sigma is 7e-6.
    assert!(
        sum.abs() <= 4.5 * error + rounding,
        "{what}: the sum over all pixels is off by {sum}, {:.1} standard errors",
        sum / error
    );
}

/// Fails unless the estimates agree with the expected values as a whole: their sum, and the size of
/// their errors.
///
/// This is for lit scenes, where rare long paths make single pixels stray far more than Student's
/// distribution allows. (Measured in a closed sphere of albedo 0.5: beyond 12 standard errors in 3
/// of 1000 pixels, the mean unbiased and the pooled error right to 2 %.)
pub fn expect_pooled_agreement(what: &str, estimates: &[Estimate]) {
    expect_total(what, estimates, |_| 1.0);
    let rms = |value: fn(&Estimate) -> f64| {
        let squares = estimates.iter().map(|estimate| value(estimate).powi(2));
        (squares.sum::<f64>() / estimates.len() as f64).sqrt()
    };
    let off = rms(|estimate| estimate.value - estimate.expected);
    let error = rms(|estimate| estimate.error);
    let rounding = ROUNDING * rms(|estimate| estimate.expected);
    // Of 144 pixels: a factor of 1.5 is five sigma of the rms where tails are normal, and two where
    // they are as above.
    assert!(
        off <= 1.5 * error + rounding,
        "{what}: pixels are off by {off} rms, their standard errors are {error}"
    );
}
