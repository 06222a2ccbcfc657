//! Margins below which a change does not matter, however certain it is.

use std::collections::BTreeMap;

use metrics::Metric;

use crate::bounds::Margin;
use crate::compare::change::{Change, ChangeKind};
use crate::compare::mean::MeanChange;

/// Margins of scores that no bound names, in their units: invisible differences.
const USUAL_MARGINS: [(Metric, f64); 2] = [(Metric::PSNR, 0.1), (Metric::SKILL, 0.02)];

/// Marks changes smaller than their margin, from bounds.toml or else the usual one.
pub fn apply_margins(
    changes: &mut [Change],
    means: &mut [MeanChange],
    margins: &BTreeMap<Metric, Margin>,
) {
    let mark = |kind: &mut ChangeKind, metric: Metric, worse: f64| {
        let usual = USUAL_MARGINS.iter().find(|(known, _)| *known == metric);
        let width = margins.get(&metric).map(|margin| margin.width);
        let margin = width.or(usual.map(|(_, width)| *width)).unwrap_or(0.0);
        if kind.is_decided() && worse.abs() < margin {
            *kind = ChangeKind::BelowMargin;
        }
    };
    for change in changes {
        let estimate = change.estimate();
        mark(&mut change.kind, change.metric, estimate);
    }
    for mean in means {
        mark(&mut mean.kind, mean.metric, mean.worse);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::change::tests::change;

    #[test]
    fn a_change_counts_from_its_margin_on() {
        let mut changes = [
            change("fan", Metric::PSNR, -4e-7, ChangeKind::Better),
            change("fan", Metric::PSNR, -0.2, ChangeKind::Better),
            change("fan", Metric::FLIP, 0.004, ChangeKind::Worse),
            change("fan", Metric::FLIP, 0.006, ChangeKind::Worse),
            change("fan", Metric::FLIP, 0.001, ChangeKind::WithinNoise),
        ];
        let margin = Margin {
            width: 0.005,
            place: "bounds.toml:3".to_owned(),
        };
        let margins = BTreeMap::from([(Metric::FLIP, margin)]);
        apply_margins(&mut changes, &mut [], &margins);
        let expected = [
            ChangeKind::BelowMargin,
            ChangeKind::Better,
            ChangeKind::BelowMargin,
            ChangeKind::Worse,
            ChangeKind::WithinNoise,
        ];
        assert_eq!(changes.map(|change| change.kind), expected);
    }
}
