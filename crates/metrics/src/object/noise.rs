//! Errors that a truth has on one object by its own noise.

use frame::{Plane, Regions};
use serde::{Deserialize, Serialize};

use crate::label::average_on_object;
use crate::picture::error_maps::ErrorMaps;

/// Mean errors of a truth's first half on one object; none if it is not seen where anything moves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObjectNoise {
    /// Label total variation.
    pub label: Option<f64>,
    /// LDR-FLIP.
    pub flip: Option<f64>,
}

impl ObjectNoise {
    /// Pools the errors of the first half over an object, given by the truth's matte.
    pub fn new(errors: &ErrorMaps, matte: &Plane, regions: &Regions) -> Self {
        Self {
            label: average_on_object(&errors.label, matte, &regions.moving),
            flip: average_on_object(&errors.flip, matte, &regions.moving),
        }
    }
}
