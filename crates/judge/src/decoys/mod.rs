//! Wrong blurs of a scene, made from its frame: the one most like a picture is the first guess at
//! the picture's mistake.

mod wrong;

use frame::{Frame, Image, Picture, Truth};
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

/// Cosine below which a picture does not change the best blur as a wrong one does.
const SMALLEST_COSINE: f64 = 0.5;

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
    decoys: Vec<Decoy>,
    /// The best blur of the frame.
    best: Decoy,
    /// Largest deviation of any wrong blur per score, the unit of its deviations.
    scales: Vec<f64>,
}

/// A wrong blur, or the best one.
struct Decoy {
    name: String,
    deviations: Deviations,
    color: Image,
}

/// Signed distances from perfect of the scores in [`COMPARED`]; none if a score does not apply.
type Deviations = Vec<Option<f64>>;

impl Decoys {
    /// Makes wrong blurs from a frame without guard band and scores them. `few_subframes`, the mean
    /// of [`FEW_SUBFRAMES`], is one of them if given.
    pub fn new(
        frame: &Frame,
        truth: &Truth,
        few_subframes: Option<Picture>,
        reference: &Reference,
    ) -> Result<Self, MeasureError> {
        let measure = |(name, picture): (String, Picture)| -> Result<Decoy, MeasureError> {
            Ok(Decoy {
                name,
                deviations: deviations(&reference.measure(&picture)?.scores),
                color: picture.color,
            })
        };
        let wrong = make_wrong_pictures(frame, truth, few_subframes);
        let decoys: Vec<Decoy> = wrong.into_iter().map(measure).collect::<Result<_, _>>()?;
        let best = scatter_oracle(frame, truth.shutter, &truth.shutter_profile);
        let best = measure(("best".to_owned(), best))?;
        let scale = |score: usize| {
            let sizes = decoys.iter().filter_map(|decoy| decoy.deviations[score]);
            sizes.map(f64::abs).fold(0.0, f64::max)
        };
        let scales = (0..COMPARED.len()).map(scale).collect();
        Ok(Self {
            decoys,
            best,
            scales,
        })
    }

    /// Finds the wrong blur whose scores are most like a picture's, among those that change the best
    /// blur as the picture does. None if these are far from all, or nearer to the best blur of the
    /// frame: a flipped y is no mistake where things move sideways.
    pub fn nearest(&self, scores: &Scores, picture: &Image) -> Option<Resemblance> {
        let measured = deviations(scores);
        let perfect = measured.iter().map(|score| score.map(|_| 0.0)).collect();
        let alike = self.decoys.iter().filter_map(|decoy| {
            let apart = self.apart(&measured, &decoy.deviations)?;
            let distance = apart / self.apart(&perfect, &decoy.deviations)?;
            let best = self.apart(&measured, &self.best.deviations);
            let is_best = best.is_some_and(|best| best <= apart);
            let cosine = cosine_of_changes(&self.best.color, picture, &decoy.color);
            let is_alike = distance <= FARTHEST && cosine >= SMALLEST_COSINE;
            (is_alike && !is_best).then(|| Resemblance {
                decoy: decoy.name.clone(),
                distance,
            })
        });
        alike.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// Returns the distance over the scores that both have; none if these are too few.
    fn apart(&self, one: &Deviations, other: &Deviations) -> Option<f64> {
        let both = one.iter().zip(other).zip(&self.scales);
        let steps = both.filter_map(|((one, other), scale)| {
            (*scale > 0.0).then_some((((*one)? - (*other)?) / scale).powi(2))
        });
        let steps: Vec<f64> = steps.collect();
        (steps.len() >= MIN_SCORES).then(|| steps.iter().sum::<f64>().sqrt())
    }
}

/// Returns the cosine between what two pictures change in a third: 1 if they change the same, not a
/// number if one changes nothing.
fn cosine_of_changes(from: &Image, one: &Image, other: &Image) -> f64 {
    let changes = |image: &Image| -> Vec<f64> {
        let pairs = image.pixels.as_flattened().iter();
        let pairs = pairs.zip(from.pixels.as_flattened());
        pairs.map(|(a, b)| f64::from(a - b)).collect()
    };
    let (one, other) = (changes(one), changes(other));
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    product(&one, &other) / (product(&one, &one) * product(&other, &other)).sqrt()
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
