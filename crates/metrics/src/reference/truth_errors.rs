//! Errors that a truth has by itself.

use frame::{Picture, Region, Regions};
use serde::{Deserialize, Serialize};

use crate::object::noise::ObjectNoise;
use crate::picture::error_maps::ErrorMaps;
use crate::picture::pooled::Pooled;
use crate::skill::Ends;
use crate::subframes::ladder::Curves;

/// Errors that a truth has whatever is measured against it: by its noise, of the pictures that
/// skill is measured between, and of its ladder's rungs. To measure them takes longer than to
/// measure a picture, so that they are worth keeping.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TruthErrors {
    /// Noise floors of every region in the order of [`Region::ALL`], from the errors of the truth's
    /// first half against the mean: the two differ by as much as the mean's own noise.
    pub(crate) noise: [Option<Pooled>; Region::ALL.len()],
    /// The same on each object, from id 1 on.
    pub(crate) objects: Vec<ObjectNoise>,
    /// The two pictures that skill is measured between; none until they are given.
    pub(crate) ends: Option<Ends>,
    /// Errors of the rungs of the ladder; none without a ladder.
    pub(crate) curves: Curves,
}

impl TruthErrors {
    /// Pools the errors of the first half against the mean.
    pub(crate) fn of_noise(
        noise: [Option<Pooled>; Region::ALL.len()],
        errors: &ErrorMaps,
        mean: &Picture,
        regions: &Regions,
    ) -> Self {
        let of_object = |matte| ObjectNoise::new(errors, matte, regions);
        Self {
            noise,
            objects: mean.coverage[1..].iter().map(of_object).collect(),
            ends: None,
            curves: Curves::default(),
        }
    }
}
