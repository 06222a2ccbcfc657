//! Scores of probes.

use frame::{AtInstant, Region, Regions, Truth};

use super::origins::{Origin, TrueOrigins, find_gathered_origin};
use super::pictures::Probes;
use crate::math::raster::{index_pixels, map_pixels};
use crate::{Measured, ProbeMaps, ProbeScores};

/// Probe scores and the maps that they were pooled from.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeMeasurement {
    /// The numbers.
    pub scores: ProbeScores,
    /// The pictures.
    pub maps: ProbeMaps,
}

/// Origins in the truth, to score any number of probes against.
pub struct OriginReference {
    expected: TrueOrigins,
    /// Mean differences of the truth's first half over the knowable region; none if that is empty.
    noise: Option<Difference>,
}

impl OriginReference {
    /// Finds the origins in the truth; `mean` is the mean of its halves at the instant.
    pub fn new(truth: &Truth, mean: &AtInstant, regions: &Regions) -> Self {
        let expected = TrueOrigins::new(mean);
        let half = TrueOrigins::new(&truth.at_instant[0]);
        let differences = (regions.indices(Region::Knowable))
            .filter_map(|at| Difference::new(half.at(at), expected.at(at)));
        Self {
            noise: average(differences),
            expected,
        }
    }

    /// Scores probes.
    pub fn measure(&self, probes: &Probes, regions: &Regions) -> ProbeMeasurement {
        let unity = map_pixels(&probes.weight, |weight| (f64::from(*weight) - 1.0).abs());
        let largest = unity.pixels.iter().copied().fold(0.0, f64::max);
        let errors = index_pixels(&regions.knowable, |at| {
            regions.knowable.pixels[at]
                .then(|| Difference::new(find_gathered_origin(probes, at), self.expected.at(at)))?
        });
        let inside = regions.indices(Region::Knowable);
        let mean = average(inside.filter_map(|at| errors.pixels[at]));
        let score = |part: fn(&Difference) -> f64| {
            let [mean, noise] =
                [&mean, &self.noise].map(|difference| difference.as_ref().map(part));
            Measured::of(
                mean,
                noise,
                "no moving pixel is seen whole in the frame of the instant",
            )
        };
        let plane = |part: fn(&Difference) -> f64| {
            map_pixels(&errors, |difference| {
                difference.as_ref().map_or(0.0, part) as f32
            })
        };
        ProbeMeasurement {
            scores: ProbeScores {
                unity: Measured::score(largest, 0.0),
                gather_offset: score(|difference| difference.offset),
                gather_spread: score(|difference| difference.spread),
            },
            maps: ProbeMaps {
                unity: map_pixels(&unity, |difference| *difference as f32),
                offset: plane(|difference| difference.offset),
                spread: plane(|difference| difference.spread),
            },
        }
    }
}

/// Difference of two origins.
#[derive(Clone, Copy)]
struct Difference {
    offset: f64,
    spread: f64,
}

impl Difference {
    /// Compares two origins; `None` unless both exist.
    fn new(origin: Option<Origin>, expected: Option<Origin>) -> Option<Self> {
        let (origin, expected) = (origin?, expected?);
        let [x, y] = [0, 1].map(|axis| origin.offset[axis] - expected.offset[axis]);
        Some(Self {
            offset: x.hypot(y),
            spread: (origin.spread - expected.spread).abs(),
        })
    }
}

/// Averages differences; `None` if there are none.
fn average(differences: impl Iterator<Item = Difference>) -> Option<Difference> {
    let (mut sum, mut count) = ([0.0; 2], 0_u32);
    for difference in differences {
        sum[0] += difference.offset;
        sum[1] += difference.spread;
        count += 1;
    }
    let [offset, spread] = sum.map(|sum| sum / f64::from(count));
    (count > 0).then_some(Difference { offset, spread })
}
