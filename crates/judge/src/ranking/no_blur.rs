//! No blur, the reference that a filter should beat.

use crate::ranking::filters::RankedFilter;

/// Describes a ranked shutter in which no filter is clearly better than no blur; none if one is, or
/// if no blur was not measured.
pub fn no_gain_text(group: &[RankedFilter]) -> Option<&'static str> {
    let mut filters = group.iter().filter(|filter| filter.is_ranked()).peekable();
    if filters.peek().is_none() {
        return Some("nothing but no blur was measured");
    }
    let is_as_bad = |filter: &RankedFilter| filter.beats_no_blur == Some(false);
    filters
        .all(is_as_bad)
        .then_some("no filter is clearly better than no blur")
}

#[cfg(test)]
mod tests {
    use measure::IDENTITY;

    use super::*;
    use crate::ranking::filters::tests::score;
    use crate::ranking::filters::{RankedScore, rank_by_score};

    /// Ranks filters, with their values per scene and a floor of 0.01, next to no blur as a
    /// reference.
    fn rank(filters: &[(&str, &[f64])], no_blur: &[f64]) -> Vec<RankedFilter> {
        let scores = |name: &str, values: &[f64]| -> Vec<RankedScore> {
            let scores = values.iter().enumerate();
            scores
                .map(|(scene, value)| score(name, scene, *value, 0.01))
                .collect()
        };
        let filters = filters
            .iter()
            .flat_map(|(name, values)| scores(name, values));
        let groups = rank_by_score(
            &filters.collect::<Vec<_>>(),
            &scores(IDENTITY, no_blur),
            false,
        );
        groups.concat()
    }

    #[test]
    fn no_blur_has_a_place_and_no_rank() {
        let ranking = rank(
            &[(IDENTITY, &[0.1]), ("worse", &[0.2]), ("worst", &[0.3])],
            &[],
        );
        let ranks: Vec<String> = ranking.iter().map(RankedFilter::rank_text).collect();
        assert_eq!(ranks, ["-", "1", "2"]);
        assert!(!ranking[0].may_be_best() && ranking[1].may_be_best());
    }

    #[test]
    fn a_gain_over_no_blur_is_said_to_be_missing_unless_a_filter_has_one() {
        let missing = Some("no filter is clearly better than no blur");
        for (filters, no_blur, expected) in [
            (&[("own", &[0.2][..])][..], &[0.1][..], missing),
            (&[("own", &[0.095])], &[0.1], missing),
            (&[("own", &[0.08])], &[0.1], None),
            (&[("own", &[0.2]), ("other", &[0.08])], &[0.1], None),
            // Two scenes give a wide interval, but the filter is better on both.
            (&[("own", &[0.08, 0.2])], &[0.1, 0.9], None),
            (&[("own", &[0.08, 0.2])], &[0.1, 0.15], missing),
            (&[("own", &[0.2])], &[], None),
            (
                &[(IDENTITY, &[0.2])],
                &[],
                Some("nothing but no blur was measured"),
            ),
        ] {
            assert_eq!(
                no_gain_text(&rank(filters, no_blur)),
                expected,
                "{filters:?}"
            );
        }
    }
}
