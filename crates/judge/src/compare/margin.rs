//! Margins below which a change does not matter, however certain it is.

use std::collections::BTreeMap;

use metrics::Metric;

use crate::bounds::Margin;
use crate::compare::RunComparison;
use crate::compare::change::ChangeKind;
use crate::compare::mean::MeanKind;

/// Margins of scores that no bound names, in their units: differences that nobody sees.
const USUAL_MARGINS: [(Metric, f64); 2] = [(Metric::PSNR, 0.1), (Metric::SKILL, 0.02)];

impl RunComparison {
    /// Marks changes that are smaller than their margin: those of bounds.toml, or else the usual ones.
    pub fn apply_margins(&mut self, margins: &BTreeMap<Metric, Margin>) {
        let margin = |metric: Metric| {
            let usual = USUAL_MARGINS.iter().find(|(own, _)| *own == metric);
            let own = margins.get(&metric).map(|margin| margin.width);
            own.or(usual.map(|(_, width)| *width)).unwrap_or(0.0)
        };
        for change in &mut self.changes {
            if change.is_beyond_noise() && change.estimate().abs() < margin(change.metric) {
                change.kind = ChangeKind::BelowMargin;
            }
        }
        for mean in &mut self.means {
            let is_decided = matches!(mean.kind, MeanKind::Better | MeanKind::Worse);
            if is_decided && mean.worse.abs() < margin(mean.metric) {
                mean.kind = MeanKind::BelowMargin;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::COMPARE_FORMAT;
    use crate::compare::change::tests::change;
    use suite::PROGRAM;

    #[test]
    fn a_change_counts_from_its_margin_on() {
        let changes = vec![
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
        let mut compared = RunComparison {
            format: COMPARE_FORMAT,
            program: PROGRAM,
            runs: ["a".to_owned(), "b".to_owned()],
            settings: Vec::new(),
            only_in_first: Vec::new(),
            only_in_second: Vec::new(),
            means: crate::compare::mean::average_changes(&changes),
            changes,
        };
        compared.apply_margins(&BTreeMap::from([(Metric::FLIP, margin)]));
        let kinds: Vec<ChangeKind> = compared.changes.iter().map(|change| change.kind).collect();
        let expected = [
            ChangeKind::BelowMargin,
            ChangeKind::Better,
            ChangeKind::BelowMargin,
            ChangeKind::Worse,
            ChangeKind::WithinNoise,
        ];
        assert_eq!(kinds, expected);
    }
}
