//! Growth and shrinking across the motion.

use crate::rows::Grid;

/// How far silhouettes moved sideways, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lateral {
    /// Pixels by which each lateral silhouette grew.
    pub growth: f64,
    /// Pixels by which each lateral silhouette shrank.
    pub shrink: f64,
}

/// Compares the mass of rows along the motion. A translation only shifts mass along its rows, so that a row's mass
/// differs from the truth's by lateral errors alone, whatever the blur's length or side; a silhouette of `length` pixels
/// (both sides together) that is dilated by d pixels adds `d * length` of mass.
pub fn lateral(output: &Grid, truth: &Grid, length: f64) -> Lateral {
    let mut mass = Lateral {
        growth: 0.0,
        shrink: 0.0,
    };
    for (output, truth) in output.rows().zip(truth.rows()) {
        let more = output.iter().sum::<f64>() - truth.iter().sum::<f64>();
        mass.growth += more.max(0.0);
        mass.shrink += (-more).max(0.0);
    }
    Lateral {
        growth: mass.growth / length,
        shrink: mass.shrink / length,
    }
}
