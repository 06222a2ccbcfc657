//! All scores of one picture.

use serde::{Deserialize, Serialize};

use crate::{
    Equivalent, EquivalentScores, FrozenScores, ImageScores, LabelScores, Measured, Metric,
    ObjectMetric, ObjectScores, ProbeScores, Region, Score, SkillScores,
};

/// All scores of one picture against one truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    /// Errors of colour where anything moves.
    pub moving: ImageScores,
    /// Errors of colour where anything moves, without the margin for bleed.
    pub support: ImageScores,
    /// Errors of colour where nothing moves.
    #[serde(rename = "static")]
    pub still: ImageScores,
    /// Errors of colour over the whole picture.
    pub full: ImageScores,
    /// Errors of colour where the frame of the instant shows all that the shutter sees.
    pub knowable: ImageScores,
    /// Errors of colour where the frame of the instant hides a part of that.
    pub unknowable: ImageScores,
    /// Errors against the truth with frozen shading.
    pub frozen: FrozenScores,
    /// Root mean square change of the instant's colour where nothing moves, relative to its
    /// brightness.
    pub static_contamination: Measured,
    /// Errors of labels: the objects that the shutter's time was given to.
    pub label_total_variation: LabelScores,
    /// Scores of every object but the background.
    pub objects: Vec<ObjectScores>,
    /// Scores of probes.
    pub probes: ProbeScores,
    /// Share of the way from no blur to the one-frame oracle.
    pub skill: SkillScores,
    /// Equivalent sub-frames.
    pub equivalent_subframes: EquivalentScores,
}

impl Scores {
    /// Returns the score of a metric. A score per object is the worst of the objects that move (or,
    /// for occluder contamination, that do not).
    pub fn get(&self, metric: Metric) -> Measured {
        match metric {
            Metric::Image(metric, region) => self.of_region(region).get(metric).clone(),
            Metric::Label(metric) => self.label_total_variation.get(metric).clone(),
            Metric::StaticContamination => self.static_contamination.clone(),
            Metric::Frozen(metric) => self.frozen.get(metric).clone(),
            Metric::Probe(metric) => self.probes.get(metric).clone(),
            Metric::Skill(metric) => self.skill.get(metric).clone(),
            Metric::Object(object) => self.worst_of(metric, object, true),
            Metric::OccluderContamination => {
                self.worst_of(metric, ObjectMetric::LabelTotalVariation, false)
            }
            Metric::Equivalent(metric) => self.equivalent_subframes.get(metric).measured(),
            Metric::Bleed => self.get(self.behind(metric)),
            Metric::Sequence(_) => Measured::not_applicable("it is a score of a sequence"),
            Metric::CommonFlip => Measured::not_applicable("it was measured against one shutter"),
        }
    }

    /// Returns the metric behind a score: for bleed, the side that has the most.
    pub fn behind(&self, metric: Metric) -> Metric {
        let Metric::Bleed = metric else {
            return metric;
        };
        let largest = self.largest_bleed();
        Metric::Object(largest.map_or(ObjectMetric::BleedLateral, |(side, _)| side))
    }

    /// Writes a score, or an estimate of it, as tables do: `0.063`, `4.80>`, `<1`, `n/a`.
    pub fn text(&self, metric: Metric, value: Option<f64>) -> String {
        match (metric, value) {
            // Counts of sub-frames have open ends, estimates have none.
            (Metric::SUBFRAMES, _) => self.equivalent_subframes.mse.to_string(),
            (_, None) => "n/a".to_owned(),
            (Metric::Bleed, Some(value)) => metric.number(value) + self.bleed_mark(),
            (_, Some(value)) => metric.number(value),
        }
    }

    /// Returns the mark that says on which side the largest bleed is.
    fn bleed_mark(&self) -> &'static str {
        match self.largest_bleed() {
            Some((ObjectMetric::BleedLeading, _)) => ">",
            Some((ObjectMetric::BleedTrailing, _)) => "<",
            _ => "",
        }
    }

    /// Finds the largest of the three bleeds of the worst moving objects, and its metric; `None` if
    /// no bleed applies. Of equal ones, lateral comes before leading and trailing.
    pub fn largest_bleed(&self) -> Option<(ObjectMetric, Score)> {
        let bleeds = [
            ObjectMetric::BleedLateral,
            ObjectMetric::BleedLeading,
            ObjectMetric::BleedTrailing,
        ];
        let found = bleeds.into_iter().filter_map(|bleed| {
            let (_, score) = self.worst_object(Metric::Object(bleed))?;
            Some((bleed, score))
        });
        found.reduce(|largest, other| {
            if other.1.value > largest.1.value {
                other
            } else {
                largest
            }
        })
    }

    /// Finds the name of the object with the worst score, and that score; `None` for metrics that
    /// are not per object.
    pub fn worst_object(&self, metric: Metric) -> Option<(&str, Score)> {
        let (object, moves) = match metric {
            Metric::Object(object) => (object, true),
            Metric::OccluderContamination => (ObjectMetric::LabelTotalVariation, false),
            _ => return None,
        };
        self.objects
            .iter()
            .filter(|scores| scores.moves == moves)
            .filter_map(|scores| match scores.get(object) {
                Measured::Score(score) => Some((scores.object.as_str(), *score)),
                Measured::NotApplicable { .. } => None,
            })
            .max_by(|(_, a), (_, b)| {
                let badness = |score: &Score| metric.ideal().badness(score.value);
                badness(a).total_cmp(&badness(b))
            })
    }

    /// Replaces every score that depends on mattes by the reason why it means nothing.
    pub fn take_out_mattes(&mut self, reason: &str) {
        self.label_total_variation = LabelScores::not_applicable(reason);
        self.skill.label_total_variation = Measured::not_applicable(reason);
        self.equivalent_subframes.label_total_variation = Equivalent::not_applicable(reason);
        for scores in &mut self.objects {
            // FLIP on an object needs the true matte alone.
            let own = ObjectMetric::ALL.into_iter();
            for metric in own.filter(|metric| *metric != ObjectMetric::Flip) {
                *scores.get_mut(metric) = Measured::not_applicable(reason);
            }
        }
    }

    /// Replaces every score that depends on the motion of objects by the reason why that is not
    /// known. The moving region stays: it also follows the colours.
    pub fn take_out_motion(&mut self, reason: &str) {
        for scores in &mut self.objects {
            // Which objects stand still is not known.
            scores.moves = true;
            for metric in ObjectMetric::ALL {
                if !matches!(
                    metric,
                    ObjectMetric::Flip | ObjectMetric::LabelTotalVariation
                ) {
                    *scores.get_mut(metric) = Measured::not_applicable(reason);
                }
            }
        }
    }

    /// Replaces every score that depends on what was seen at the instant by the reason why that is
    /// not known.
    pub(crate) fn take_out_instant(&mut self, reason: &'static str) {
        self.knowable = ImageScores::not_applicable(reason);
        self.unknowable = ImageScores::not_applicable(reason);
        self.frozen = FrozenScores::not_applicable(reason);
    }

    fn of_region(&self, region: Region) -> &ImageScores {
        match region {
            Region::Moving => &self.moving,
            Region::Support => &self.support,
            Region::Still => &self.still,
            Region::Full => &self.full,
            Region::Knowable => &self.knowable,
            Region::Unknowable => &self.unknowable,
        }
    }

    fn worst_of(&self, metric: Metric, object: ObjectMetric, moves: bool) -> Measured {
        if let Some((_, score)) = self.worst_object(metric) {
            return Measured::Score(score);
        }
        let reasons: Vec<String> = self
            .objects
            .iter()
            .filter(|scores| scores.moves == moves)
            .filter_map(|scores| match scores.get(object) {
                Measured::Score(_) => None,
                Measured::NotApplicable { reason } => Some(format!("{}: {reason}", scores.object)),
            })
            .collect();
        // One reason took all of them out.
        let label = &self.label_total_variation.mean;
        let mut objects = self.objects.iter();
        if label.value().is_none() && objects.all(|scores| scores.get(object) == label) {
            label.clone()
        } else if reasons.is_empty() {
            Measured::not_applicable(if moves {
                "no object moves on screen"
            } else {
                "no object but the background is still"
            })
        } else {
            Measured::not_applicable(reasons.join("; "))
        }
    }
}
