//! Scores that tables, means over scenes and pages show.

use metrics::{
    Ideal, ImageMetric, Interval, LabelMetric, Measured, Metric, ObjectMetric, Region, Scores,
    SkillMetric,
};

use crate::run::case::{Case, IDENTITY, SCATTER_ORACLE};

/// A score of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Headline {
    /// One that is measured against the filter's own shutter.
    Metric(Metric),
    /// The largest of the bleeds beside, ahead of and behind a mover: `bleed`.
    Bleed,
    /// FLIP against the shutter that all cases are compared with: `flip_common`, FLIP* in tables.
    CommonFlip,
}

impl Headline {
    /// FLIP where anything moves.
    pub const FLIP: Self = Self::Metric(Metric::Image(ImageMetric::Flip, Region::Moving));
    /// Skill in FLIP.
    pub const SKILL: Self = Self::Metric(Metric::Skill(SkillMetric::Flip));
    /// Skill in mean squared error.
    pub const SKILL_MSE: Self = Self::Metric(Metric::Skill(SkillMetric::Mse));
    /// Skill in the total variation of labels.
    pub const SKILL_LABEL: Self = Self::Metric(Metric::Skill(SkillMetric::LabelTotalVariation));
    /// PSNR where anything moves.
    pub const PSNR: Self = Self::Metric(Metric::Image(ImageMetric::Psnr, Region::Moving));
    /// Lateral growth.
    pub const GROWTH: Self = Self::Metric(Metric::Object(ObjectMetric::LateralGrowth));
    /// Row loss.
    pub const LOSS: Self = Self::Metric(Metric::Object(ObjectMetric::RowLoss));
    /// Mean total variation of labels.
    pub const LABEL: Self = Self::Metric(Metric::Label(LabelMetric::Mean));
    /// Sub-frames of equal error.
    pub const SUBFRAMES: Self = Self::Metric(Metric::SUBFRAMES);

    /// The scores that have a mean over scenes.
    pub const OF_MEANS: [Self; 10] = [
        Self::FLIP,
        Self::CommonFlip,
        Self::SKILL,
        Self::SKILL_MSE,
        Self::SKILL_LABEL,
        Self::PSNR,
        Self::GROWTH,
        Self::LOSS,
        Self::Bleed,
        Self::LABEL,
    ];

    /// Returns the name in run.json.
    pub fn name(self) -> String {
        match self {
            Self::Metric(metric) => metric.name(),
            Self::Bleed => "bleed".to_owned(),
            Self::CommonFlip => "flip_common".to_owned(),
        }
    }

    /// Returns the direction in which it is better.
    pub fn ideal(self) -> Ideal {
        match self {
            Self::Metric(metric) => metric.ideal(),
            Self::Bleed | Self::CommonFlip => Ideal::Lowest,
        }
    }

    /// Tells whether scores of two shutter alignments compare.
    pub fn spans_alignments(self) -> bool {
        matches!(self, Self::CommonFlip | Self::Metric(Metric::Skill(_)))
    }

    /// Returns the metric behind the score: for bleed that of the side with the most.
    pub fn metric(self, scores: &Scores) -> Option<Metric> {
        match self {
            Self::Metric(metric) => Some(metric),
            Self::Bleed => {
                let largest = scores.largest_bleed();
                let side = largest.map_or(ObjectMetric::BleedLateral, |(side, _)| side);
                Some(Metric::Object(side))
            }
            Self::CommonFlip => None,
        }
    }

    /// Returns a case's score.
    pub fn measured(self, case: &Case) -> Measured {
        match self {
            Self::CommonFlip => case.common.flip.clone(),
            _ => self.of_scores(&case.scores),
        }
    }

    /// Finds the noise floor of a case's score; none where the score does not apply.
    pub fn floor(self, case: &Case) -> Option<f64> {
        match self.measured(case) {
            Measured::Score(score) => Some(score.floor),
            Measured::NotApplicable { .. } => None,
        }
    }

    /// Finds the interval of a case's score; none where the run has no intervals.
    pub fn interval(self, case: &Case) -> Option<&Interval> {
        case.intervals.get(&self.metric(&case.scores)?.name())
    }

    /// Estimates a case's score against a truth without noise, which takes an interval; without one, returns the measured score.
    /// None where the score does not apply.
    pub fn estimate(self, case: &Case) -> Option<f64> {
        let measured = self.measured(case).value()?;
        Some(
            self.interval(case)
                .map_or(measured, |interval| interval.center),
        )
    }

    /// Returns a picture's score; not that against the common shutter, which no picture has alone.
    pub fn of_scores(self, scores: &Scores) -> Measured {
        match self.metric(scores) {
            Some(metric) => scores.get(metric),
            None => Measured::not_applicable("it was measured against one shutter"),
        }
    }

    /// Writes a case's estimated score: `0.063`, `4.80>`, `<1`, `n/a`.
    pub fn text(self, case: &Case) -> String {
        self.format(self.estimate(case), &case.scores)
    }

    /// Writes a picture's score.
    pub fn text_of_scores(self, scores: &Scores) -> String {
        self.format(self.of_scores(scores).value(), scores)
    }

    fn format(self, value: Option<f64>, scores: &Scores) -> String {
        match (self, value) {
            // Counts of sub-frames have ends that no estimate has.
            (Self::SUBFRAMES, _) => scores.equivalent_subframes.mse.to_string(),
            (_, None) => "n/a".to_owned(),
            (Self::Bleed, Some(value)) => self.number(value) + bleed_mark(scores),
            (_, Some(value)) => self.number(value),
        }
    }

    /// Writes a score or a mean of scores with as many digits as are useful: lengths with at most three.
    pub fn number(self, value: f64) -> String {
        let digits = match self {
            Self::PSNR | Self::SUBFRAMES => 1,
            Self::Metric(Metric::Skill(_)) => 2,
            Self::Bleed | Self::Metric(Metric::Object(_)) if value.abs() >= 9.995 => 1,
            Self::Bleed | Self::Metric(Metric::Object(_)) => 2,
            _ => 3,
        };
        // No "-0.00".
        let scale = 10f64.powi(digits);
        let rounded = (value * scale).round() / scale + 0.0;
        format!("{rounded:.*}", digits as usize)
    }

    /// Returns the weight of the case's scene in a mean over scenes: for a skill what the one-frame oracle takes away from the
    /// error of no blur, and 1 for any other score. None where `cases`, those of its run, lack the reference pictures.
    pub fn weight(self, case: &Case, cases: &[Case]) -> Option<f64> {
        let Self::Metric(Metric::Skill(skill)) = self else {
            return Some(1.0);
        };
        let error = |is_wanted: fn(&Case) -> bool| {
            let own = cases.iter().find(|own| {
                (own.is_reference && is_wanted(own))
                    && (&own.scene, &own.alignment) == (&case.scene, &case.alignment)
            });
            own?.scores.get(skill.error()).value()
        };
        // The frame is the sharp picture if its instant is the middle of the shutter.
        let sharp = error(Case::is_sharp).or_else(|| error(|own| own.filter == IDENTITY));
        Some(sharp? - error(|own| own.filter == SCATTER_ORACLE)?)
    }
}

/// Returns the mark that says where the largest bleed lies.
fn bleed_mark(scores: &Scores) -> &'static str {
    match scores.largest_bleed() {
        Some((ObjectMetric::BleedLeading, _)) => ">",
        Some((ObjectMetric::BleedTrailing, _)) => "<",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_at_most_three_digits_and_nothing_is_minus_zero() {
        for (headline, value, expected) in [
            (Headline::GROWTH, 4.8, "4.80"),
            (Headline::GROWTH, 9.999, "10.0"),
            (Headline::Bleed, 44.44, "44.4"),
            (Headline::SKILL, -0.001, "0.00"),
            (Headline::SKILL, -0.734, "-0.73"),
            (Headline::FLIP, 0.12345, "0.123"),
            (Headline::PSNR, 27.04, "27.0"),
        ] {
            assert_eq!(headline.number(value), expected);
        }
    }
}
