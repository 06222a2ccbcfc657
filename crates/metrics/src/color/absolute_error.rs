//! Absolute errors, which the truth's noise biases by as much as their floor says.

/// Added to the denominator of SMAPE, in display-scaled radiance: a convention that keeps dark
/// pixels from deciding the score.
pub const SMAPE_EPSILON: f64 = 1e-2;

/// Computes `|F - T|`, mean over the channels, of radiance times `scale`.
pub fn absolute(output: [f32; 3], truth: [f32; 3], scale: f64) -> f64 {
    average_channels(output, truth, scale, |f, t| (f - t).abs())
}

/// Computes `2 |F - T| / (|F| + |T| + epsilon)`, mean over the channels, in [0, 2].
pub fn symmetric(output: [f32; 3], truth: [f32; 3], scale: f64) -> f64 {
    average_channels(output, truth, scale, |f, t| {
        2.0 * (f - t).abs() / (f.abs() + t.abs() + SMAPE_EPSILON)
    })
}

fn average_channels(
    output: [f32; 3],
    truth: [f32; 3],
    scale: f64,
    error: impl Fn(f64, f64) -> f64,
) -> f64 {
    let channel = |c: usize| error(f64::from(output[c]) * scale, f64::from(truth[c]) * scale);
    (channel(0) + channel(1) + channel(2)) / 3.0
}
