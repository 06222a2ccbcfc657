//! Margins below which a change does not matter, however surely it is told from noise.

use std::collections::BTreeMap;

use super::Compared;
use super::change::ChangeKind;
use super::mean::MeanKind;
use crate::Margin;
use crate::stats::headline::Headline;

/// Margins of scores that no bound names, in their units: differences that nobody sees.
const USUAL_MARGINS: [(Headline, f64); 2] = [(Headline::PSNR, 0.1), (Headline::SKILL, 0.02)];

impl Compared {
    /// Marks changes that are smaller than their margin: those of bounds.toml, or else the usual ones.
    pub fn apply_margins(&mut self, margins: &BTreeMap<String, Margin>) {
        let margin = |metric: &str| {
            let usual = USUAL_MARGINS
                .iter()
                .find(|(headline, _)| headline.name() == metric);
            let own = margins.get(metric).map(|margin| margin.width);
            own.or(usual.map(|(_, width)| *width)).unwrap_or(0.0)
        };
        for change in &mut self.changes {
            let is_told = matches!(change.kind, ChangeKind::Better | ChangeKind::Worse);
            if is_told && change.worse.abs() < margin(&change.metric) {
                change.kind = ChangeKind::BelowMargin;
            }
        }
        for mean in &mut self.means {
            let is_told = matches!(mean.kind, MeanKind::Better | MeanKind::Worse);
            if is_told && mean.worse.abs() < margin(&mean.metric) {
                mean.kind = MeanKind::BelowMargin;
            }
        }
    }
}
