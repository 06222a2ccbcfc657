//! Result of measuring one picture.

use frame::Plane;

use crate::{ErrorMap, Maps, ProbeMaps, Scores};

/// Scores, and the maps that they were pooled from.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// The numbers.
    pub scores: Scores,
    /// The pictures.
    pub maps: Maps,
    /// Maps of probes, if any were run.
    pub probes: Option<ProbeMaps>,
}

impl Measurement {
    /// Returns a map; `None` for one of probes if none were run.
    pub fn map(&self, map: ErrorMap) -> Option<&Plane> {
        let (maps, probes) = (&self.maps, self.probes.as_ref());
        match map {
            ErrorMap::SquaredError => Some(&maps.squared_error),
            ErrorMap::RelativeSquaredError => Some(&maps.relative_squared_error),
            ErrorMap::AbsoluteError => Some(&maps.absolute_error),
            ErrorMap::SymmetricError => Some(&maps.symmetric_error),
            ErrorMap::Ssim => Some(&maps.ssim),
            ErrorMap::Flip => Some(&maps.flip),
            ErrorMap::FlipHdr => Some(&maps.flip_hdr),
            ErrorMap::LabelTotalVariation => Some(&maps.label_total_variation),
            ErrorMap::Bleed => Some(&maps.bleed),
            ErrorMap::GradientError => Some(&maps.gradient_error),
            ErrorMap::FrozenSquaredError => Some(&maps.frozen_squared_error),
            ErrorMap::StaticChange => Some(&maps.static_change),
            ErrorMap::Unity => probes.map(|probes| &probes.unity),
            ErrorMap::GatherOffset => probes.map(|probes| &probes.offset),
            ErrorMap::GatherSpread => probes.map(|probes| &probes.spread),
        }
    }
}
