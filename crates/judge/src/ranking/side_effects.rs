//! What filters change that FLIP where anything moves does not show.

use measure::{TWO_SIDED, plain_mean};
use metrics::Metric;

/// Limit on the change of the brightness where nothing moves: filters that change more rank behind
/// all others.
pub const STILL_LIMIT: f64 = 0.01;
/// Limit on grain: tables mark more of it.
pub const GRAIN_LIMIT: f64 = 0.018;

/// Explanation of the two for readers.
pub const SIDE_EFFECTS_RULE: &str = "! marks still (change where nothing moves) above 0.010, which ranks last, and grain above 0.018.";

/// Change where nothing moves and grain, of a filter on a scene or in the mean; none if it does not
/// apply.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SideEffects {
    /// Change where nothing moves.
    pub still: Option<f64>,
    /// Grain where anything moves.
    pub grain: Option<f64>,
}

impl SideEffects {
    /// Looks up both scores.
    pub fn of(score: impl Fn(Metric) -> Option<f64>) -> Self {
        Self {
            still: score(Metric::STILL),
            grain: score(Metric::GRAIN),
        }
    }

    /// Averages those that apply.
    pub fn mean(all: &[Self]) -> Self {
        let mean = |part: fn(&Self) -> Option<f64>| {
            let values: Vec<f64> = all.iter().filter_map(part).collect();
            (!values.is_empty()).then(|| plain_mean(&values, TWO_SIDED).mean)
        };
        Self {
            still: mean(|effects| effects.still),
            grain: mean(|effects| effects.grain),
        }
    }

    /// Returns whether the filter changes what stands still by more than the limit.
    pub fn ruins_still(&self) -> bool {
        self.still.is_some_and(|still| still > STILL_LIMIT)
    }

    /// Formats both as tables do: `0.000`, `0.075!` above the limit, `n/a`.
    pub fn texts(&self) -> [String; 2] {
        let text = |metric: Metric, value: Option<f64>, limit: f64| match value {
            None => "n/a".to_owned(),
            Some(value) if value > limit => metric.number(value) + "!",
            Some(value) => metric.number(value),
        };
        [
            text(Metric::STILL, self.still, STILL_LIMIT),
            text(Metric::GRAIN, self.grain, GRAIN_LIMIT),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ranking::filters::rank_by_score;
    use crate::ranking::filters::tests::score;
    use crate::read_bounds_file;

    #[test]
    fn limits_are_those_of_the_shipped_bounds() {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/bounds.toml");
        let bounds = read_bounds_file(root).unwrap().default;
        let limit = |metric| bounds.get(&metric).unwrap().limit;
        assert_eq!(
            [limit(Metric::STILL), limit(Metric::GRAIN)],
            [STILL_LIMIT, GRAIN_LIMIT]
        );
        for limit in [STILL_LIMIT, GRAIN_LIMIT] {
            assert!(
                SIDE_EFFECTS_RULE.contains(&format!("{limit:.3}")),
                "{limit}"
            );
        }
    }

    #[test]
    fn a_filter_that_ruins_what_stands_still_ranks_behind_all_others() {
        let with = |name: &str, value: f64, still: f64| {
            let mut ranked = score(name, 0, value, 0.01);
            ranked.side_effects.still = Some(still);
            ranked
        };
        let scores = [
            with("ruins", 0.05, 0.02),
            with("keeps", 0.2, 0.0),
            with("touches", 0.1, 0.01),
        ];
        let ranking = rank_by_score(&scores, &[], false).concat();
        let ranks: Vec<_> = (ranking.iter())
            .map(|filter| (filter.name.as_str(), filter.rank_text()))
            .collect();
        let expected = [("touches", "1"), ("keeps", "2"), ("ruins", "3")];
        assert_eq!(ranks, expected.map(|(name, rank)| (name, rank.to_owned())));
        assert_eq!(ranking[2].side_effects.texts(), ["0.020!", "n/a"]);
    }
}
