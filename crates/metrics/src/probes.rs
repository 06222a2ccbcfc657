//! Probes: pictures of ones, coordinates and their products, whose blur tells where a filter gathers.

use frame::{AtInstant, Image, Plane, Raster, Region, Regions, Truth, Vectors};

use crate::color::pooling::mean;
use crate::{Measured, ProbeScores};

/// Sums of a filter's weights per pixel, times 1, coordinates and their products. Coordinates are in pixels from the picture's
/// middle, +x right, +y down.
#[derive(Clone, Debug, PartialEq)]
pub struct Probes {
    /// Sum of the weights.
    pub weight: Plane,
    /// Sums of weight times x and y.
    pub first: Vectors,
    /// Sums of weight times xx, xy and yy.
    pub second: Raster<[f32; 3]>,
}

/// Probe scores and the maps that they were pooled from.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeMeasurement {
    /// The numbers.
    pub scores: ProbeScores,
    /// The pictures.
    pub maps: ProbeMaps,
}

/// One map per probe score.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeMaps {
    /// Difference of the sum of weights from 1.
    pub unity: Plane,
    /// Distance between where was gathered and where should have been, in pixels; 0 where that is not defined.
    pub offset: Plane,
    /// Difference of the spreads, in pixels; 0 where that is not defined.
    pub spread: Plane,
}

impl Probes {
    /// The pictures to run through a filter: (x, y, 1) and (xx, xy, yy).
    pub fn images(width: u32, height: u32) -> [Image; 2] {
        let place = |x: u32, y: u32| {
            [
                x as f32 + 0.5 - 0.5 * width as f32,
                y as f32 + 0.5 - 0.5 * height as f32,
            ]
        };
        [
            Raster::from_fn(width, height, |x, y| {
                let [x, y] = place(x, y);
                [x, y, 1.0]
            }),
            Raster::from_fn(width, height, |x, y| {
                let [x, y] = place(x, y);
                [x * x, x * y, y * y]
            }),
        ]
    }

    /// Probes from the filter's outputs for [`Probes::images`], in their order.
    pub fn of(outputs: [&Image; 2]) -> Self {
        Self {
            weight: outputs[0].map(|sums| sums[2]),
            first: outputs[0].map(|sums| [sums[0], sums[1]]),
            second: outputs[1].clone(),
        }
    }
}

/// Origin of a pixel's light: offset from the pixel's centre, and standard deviation about it, in pixels.
#[derive(Clone, Copy)]
struct Origin {
    offset: [f64; 2],
    spread: f64,
}

/// Variance of a point within a pixel, both axes together.
const WITHIN_A_PIXEL: f64 = 2.0 / 12.0;

/// Scores probes against what the truth recalls of the instant.
pub fn measure_probes(probes: &Probes, truth: &Truth, regions: &Regions) -> ProbeMeasurement {
    let unity = probes.weight.map(|weight| (f64::from(*weight) - 1.0).abs());
    let largest = unity.pixels.iter().copied().fold(0.0, f64::max);
    let expected = origins(&truth.at_instant_mean());
    let found = gathered(probes);
    let noisy = origins(&truth.at_instant[0]);
    let errors = differences(&found, &expected);
    let noise = differences(&noisy, &expected);
    let pool = |map: fn(&Difference) -> f64| {
        let pooled = |differences: &Raster<Option<Difference>>| {
            let inside = regions.select(Region::Knowable, differences);
            let values: Vec<f64> = inside.iter().flatten().map(map).collect();
            mean(&values)
        };
        match (pooled(&errors), pooled(&noise)) {
            (Some(value), Some(noise)) => Measured::score(value, noise),
            _ => Measured::not_applicable(
                "no moving pixel is seen whole in the frame of the instant",
            ),
        }
    };
    let plane = |map: fn(&Difference) -> f64| {
        errors.map(|difference| difference.as_ref().map_or(0.0, map) as f32)
    };
    ProbeMeasurement {
        scores: ProbeScores {
            unity: Measured::score(largest, 0.0),
            gather_offset: pool(|difference| difference.offset),
            gather_spread: pool(|difference| difference.spread),
        },
        maps: ProbeMaps {
            unity: unity.map(|difference| *difference as f32),
            offset: plane(|difference| difference.offset),
            spread: plane(|difference| difference.spread),
        },
    }
}

#[derive(Clone, Copy)]
struct Difference {
    offset: f64,
    spread: f64,
}

fn differences(
    found: &Raster<Option<Origin>>,
    expected: &Raster<Option<Origin>>,
) -> Raster<Option<Difference>> {
    found.zip(expected, |found, expected| {
        let (found, expected) = (found.as_ref()?, expected.as_ref()?);
        let [x, y] = [0, 1].map(|axis| found.offset[axis] - expected.offset[axis]);
        Some(Difference {
            offset: x.hypot(y),
            spread: (found.spread - expected.spread).abs(),
        })
    })
}

/// Origins by the truth; none where a part of what is seen has no place at the instant.
fn origins(recalled: &AtInstant) -> Raster<Option<Origin>> {
    let whole = recalled.offset.zip(&recalled.spread, |offset, spread| {
        let offset = offset.map(f64::from);
        let square = f64::from(spread[0]) + f64::from(spread[2]);
        Origin {
            offset,
            spread: (square - dot(offset)).max(0.0).sqrt(),
        }
    });
    whole.zip(&recalled.placed, |origin, placed| {
        // A mean of ones is one but for rounding.
        (f64::from(*placed) > 1.0 - 1e-6).then_some(*origin)
    })
}

/// Origins by the filter; none where it gathers nothing.
fn gathered(probes: &Probes) -> Raster<Option<Origin>> {
    let (width, height) = (probes.weight.width, probes.weight.height);
    Raster::from_fn(width, height, |x, y| {
        let weight = f64::from(*probes.weight.at(x, y));
        if weight <= 0.0 {
            return None;
        }
        let middle = probes.first.at(x, y).map(|sum| f64::from(sum) / weight);
        let here = [
            f64::from(x) + 0.5 - 0.5 * f64::from(width),
            f64::from(y) + 0.5 - 0.5 * f64::from(height),
        ];
        let second = probes.second.at(x, y);
        let square = (f64::from(second[0]) + f64::from(second[2])) / weight;
        // What is gathered are pixels, each as wide as one.
        let variance = (square - dot(middle)).max(0.0) + WITHIN_A_PIXEL;
        Some(Origin {
            offset: [middle[0] - here[0], middle[1] - here[1]],
            spread: variance.sqrt(),
        })
    })
}

fn dot(v: [f64; 2]) -> f64 {
    v[0] * v[0] + v[1] * v[1]
}
