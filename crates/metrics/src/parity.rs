//! Comparison of scores with scikit-image, SciPy and NumPy: `tests/fixtures/metrics/make.py` makes
//! the same planes and stores the numbers.

use std::collections::BTreeMap;

use frame::{Image, Plane, Raster};

use crate::color::absolute_error::{absolute, symmetric};
use crate::color::cross_error::{psnr, relative_squared, squared_error};
use crate::color::ssim::{SSIM_BORDER, ssim_of};
use crate::object::gradient::{gradient_error, gradient_magnitude};
use crate::object::misplacement::measure_misplacement;
use crate::object::rows::Rows;

type Formula = fn(u32, u32) -> u32;

fn plane(formula: Formula) -> Plane {
    Raster::from_fn(61, 43, |x, y| formula(x, y) as f32 / 256.0)
}

fn ramp(x: u32, y: u32) -> u32 {
    (x * 2 + y * 3) % 257
}

fn checks(x: u32, y: u32) -> u32 {
    if (x / 6 + y / 5).is_multiple_of(2) {
        200
    } else {
        40
    }
}

fn smeared_checks(x: u32, y: u32) -> u32 {
    (0..4).map(|tap| checks(x + tap, y)).sum::<u32>() / 4
}

fn scatter(x: u32, y: u32) -> u32 {
    (x * 7919 + y * 104_729) % 251
}

fn disc(x: u32, y: u32) -> u32 {
    let [right, down] = [x.abs_diff(25), y.abs_diff(20)];
    if right * right + down * down < 150 {
        256
    } else {
        0
    }
}

fn smeared_disc(x: u32, y: u32) -> u32 {
    (0..8).map(|tap| disc(x + tap, y)).sum::<u32>() / 8
}

const PAIRS: [(&str, Formula, Formula); 4] = [
    ("smeared checks", smeared_checks, checks),
    ("scatter for ramp", scatter, ramp),
    ("smeared disc", smeared_disc, disc),
    ("disc for scatter", disc, scatter),
];

fn average(map: &Raster<f64>) -> f64 {
    map.pixels.iter().sum::<f64>() / map.pixels.len() as f64
}

fn scores(output: &Plane, truth: &Plane) -> BTreeMap<&'static str, f64> {
    let grey = |plane: &Plane| -> Image { plane.map(|value| [*value; 3]) };
    let (color, true_color) = (grey(output), grey(truth));
    let wide = |plane: &Plane| plane.map(|value| f64::from(*value));
    let similarity = ssim_of(&wide(output), &wide(truth)).cropped(SSIM_BORDER);
    let halves = [&true_color; 2];
    let mse = average(&squared_error(&color, halves, 1.0));
    let relative = color.zip(&true_color, |output, truth| {
        relative_squared(*output, [*truth; 2], *truth, 1.0)
    });
    let absolute = color.zip(&true_color, |output, truth| absolute(*output, *truth, 1.0));
    let symmetric = color.zip(&true_color, |output, truth| symmetric(*output, *truth, 1.0));
    let rows = Rows::new([1.0, 0.0], output.width, output.height);
    let apart = measure_misplacement(&rows.spread(output), &rows.spread(truth));
    let gradients = [output, truth].map(gradient_magnitude);
    let gradient = gradient_error(gradients[0].as_ref(), gradients[1].as_ref());
    let gradient = gradient.expect("neither is zero");
    BTreeMap::from([
        ("ssim", average(&similarity)),
        ("psnr", psnr(mse, 0.0)),
        ("mse", mse),
        ("mae", average(&absolute)),
        ("relmse", average(&relative)),
        ("smape", average(&symmetric)),
        ("wasserstein", apart.expect("both have mass").distance),
        (
            "gradient",
            gradient.pixels(61).map(|(_, error)| error).sum::<f64>() / (61.0 * 43.0),
        ),
    ])
}

#[test]
fn scores_are_those_of_the_tools_of_the_field() {
    type Expected = BTreeMap<String, BTreeMap<String, f64>>;
    let text = include_str!("../../../tests/fixtures/metrics/metrics.json");
    let expected: Expected = serde_json::from_str(text).expect("metrics.json holds numbers");
    assert_eq!(expected.len(), PAIRS.len());
    for (pair, output, truth) in PAIRS {
        let scores = scores(&plane(output), &plane(truth));
        assert_eq!(scores.len(), expected[pair].len());
        for (name, value) in scores {
            let expected = expected[pair][name];
            // Sums of 2623 terms in f64, in another order.
            assert!(
                (value - expected).abs() <= 1e-9 * expected.abs().max(1.0),
                "{pair}, {name}: {value}, expected {expected}"
            );
        }
    }
}
