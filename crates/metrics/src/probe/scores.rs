//! Scores of probes.

use frame::{Plane, Raster, Region, Regions, Truth};

use super::origins::{Origin, find_gathered_origins, find_true_origins};
use super::pictures::Probes;
use crate::math::pooling::mean;
use crate::{Measured, ProbeScores};

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
    /// Distance between the middle of what was gathered and the middle of what should have been, in pixels; 0 where undefined.
    pub offset: Plane,
    /// Difference of the spreads, in pixels; 0 where undefined.
    pub spread: Plane,
}

/// Scores probes against the truth's origins at the instant.
pub fn measure_probes(probes: &Probes, truth: &Truth, regions: &Regions) -> ProbeMeasurement {
    let unity = probes.weight.map(|weight| (f64::from(*weight) - 1.0).abs());
    let largest = unity.pixels.iter().copied().fold(0.0, f64::max);
    let expected = find_true_origins(&truth.at_instant_mean());
    let found = find_gathered_origins(probes);
    let noisy = find_true_origins(&truth.at_instant[0]);
    let errors = compare_origins(&found, &expected);
    let noise = compare_origins(&noisy, &expected);
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

/// Difference of two origins.
#[derive(Clone, Copy)]
struct Difference {
    offset: f64,
    spread: f64,
}

fn compare_origins(
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

impl ProbeScores {
    /// Makes scores that do not apply, because of `reason`.
    pub fn not_applicable(reason: &str) -> Self {
        let none = || Measured::not_applicable(reason);
        Self {
            unity: none(),
            gather_offset: none(),
            gather_spread: none(),
        }
    }
}
