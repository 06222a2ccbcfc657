//! Wrong blurs of a scene, made from its frame: the one most like a picture is the first guess at
//! the picture's mistake.

mod wrong;

use frame::{Frame, Picture, Truth};
use metrics::{Ideal, MeasureError, Metric, ObjectMetric, Reference, Scores, scatter_oracle};
use serde::{Deserialize, Serialize};

pub use wrong::{FEW_SUBFRAMES, make_wrong_pictures};

/// Wrong blur that a picture resembles most.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Resemblance {
    /// Name of the wrong blur.
    pub decoy: String,
    /// Distance of the scores from the wrong blur's, as a fraction of the wrong blur's distance
    /// from perfect: 0 is equal.
    pub distance: f64,
}

/// Distance beyond which a picture resembles none.
const FARTHEST: f64 = 0.5;

/// Distance of the best blur of a frame up to which a wrong blur is as good as right.
const NEAREST: f64 = 0.1;

/// Smallest number of scores that show a resemblance.
const MIN_SCORES: usize = 4;

/// Scores that distinguish wrong blurs, by position, length, width and looks.
const COMPARED: [Metric; 15] = [
    Metric::FLIP,
    Metric::STILL,
    Metric::LABEL,
    Metric::Object(ObjectMetric::BleedLateral),
    Metric::Object(ObjectMetric::BleedLeading),
    Metric::Object(ObjectMetric::BleedTrailing),
    Metric::GROWTH,
    Metric::Object(ObjectMetric::RowGain),
    Metric::LOSS,
    Metric::Object(ObjectMetric::Misplacement),
    Metric::Object(ObjectMetric::Centroid),
    Metric::Object(ObjectMetric::Extent),
    Metric::Object(ObjectMetric::Hole),
    Metric::Object(ObjectMetric::Deficit),
    Metric::Object(ObjectMetric::Energy),
];

/// Scores of wrong blurs of one scene against one truth.
pub struct Decoys {
    decoys: Vec<(String, Deviations)>,
    /// Largest deviation of any wrong blur per score, the unit of its deviations.
    scales: Vec<f64>,
}

/// Signed distances from perfect of the scores in [`COMPARED`]; none if a score does not apply.
type Deviations = Vec<Option<f64>>;

impl Decoys {
    /// Makes wrong blurs from a frame without guard band and scores them. `few_subframes`, the mean
    /// of [`FEW_SUBFRAMES`], is one of them if given. Those that equal the best blur of the frame
    /// are left out: a flipped y where things move sideways.
    pub fn new(
        frame: &Frame,
        truth: &Truth,
        few_subframes: Option<Picture>,
        reference: &Reference,
    ) -> Result<Self, MeasureError> {
        let measure = |picture: &Picture| -> Result<Deviations, MeasureError> {
            Ok(deviations(&reference.measure(picture)?.scores))
        };
        let mut decoys = Vec::new();
        for (name, picture) in make_wrong_pictures(frame, truth, few_subframes) {
            decoys.push((name, measure(&picture)?));
        }
        let best = scatter_oracle(frame, truth.shutter, &truth.shutter_profile);
        let best = measure(&best)?;
        let scale = |score: usize| {
            let sizes = decoys.iter().filter_map(|(_, decoy)| decoy[score]);
            sizes.map(f64::abs).fold(0.0, f64::max)
        };
        let scales = (0..COMPARED.len()).map(scale).collect();
        let mut decoys = Self { decoys, scales };
        let is_wrong = |(_, decoy): &(String, Deviations)| {
            (decoys.distance(&best, decoy)).is_none_or(|distance| distance > NEAREST)
        };
        let kept = decoys.decoys.iter().filter(|decoy| is_wrong(decoy));
        decoys.decoys = kept.cloned().collect();
        Ok(decoys)
    }

    /// Finds the wrong blur that these scores resemble most; none if they are far from all.
    pub fn nearest(&self, scores: &Scores) -> Option<Resemblance> {
        let measured = deviations(scores);
        let distances = self.decoys.iter().filter_map(|(name, decoy)| {
            let distance = self.distance(&measured, decoy)?;
            (distance <= FARTHEST).then(|| Resemblance {
                decoy: name.clone(),
                distance,
            })
        });
        distances.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// Returns the distance over the scores that both have, as a fraction of the decoy's own
    /// distance from perfect; none if there are too few such scores, or the decoy is perfect in
    /// them.
    fn distance(&self, measured: &Deviations, decoy: &Deviations) -> Option<f64> {
        let (mut apart, mut whole, mut count) = (0.0, 0.0, 0);
        for ((measured, decoy), scale) in measured.iter().zip(decoy).zip(&self.scales) {
            if let (Some(measured), Some(decoy)) = (measured, decoy)
                && *scale > 0.0
            {
                apart += ((measured - decoy) / scale).powi(2);
                whole += (decoy / scale).powi(2);
                count += 1;
            }
        }
        (whole > 0.0 && count >= MIN_SCORES).then(|| (apart / whole).sqrt())
    }
}

fn deviations(scores: &Scores) -> Deviations {
    COMPARED
        .map(|metric| {
            let perfect = match metric.ideal() {
                Ideal::Target(target) => target,
                Ideal::Lowest | Ideal::Highest => 0.0,
            };
            scores.get(metric).value().map(|value| value - perfect)
        })
        .to_vec()
}
