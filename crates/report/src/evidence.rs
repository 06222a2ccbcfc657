//! Evidence of a bound that is not kept: the place to look at, and the map that was searched.

use std::str::FromStr;

use metrics::Metric;

use super::precision::Nature;
use super::scene_files::{CaseFiles, SceneFiles};
use suite::{Case, Error};
use suite::{Finding, worst_block};

/// The worst place of one score.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// Middle of the block whose error is largest.
    pub place: [u32; 2],
    /// The error map, as errors.exr calls it.
    pub map: String,
    /// The map's plane on the scene's shelf.
    pub plane: usize,
}

/// None for a finding that needs no explanation. A `check` has looked for the place; for a `run` it is looked for here.
pub fn evidence(
    finding: &Finding,
    case: &Case,
    files: &CaseFiles,
    scene: &mut SceneFiles,
) -> Result<Option<Evidence>, Error> {
    if !finding.outcome.is_notable() {
        return Ok(None);
    }
    let metric = Metric::from_str(&finding.metric).expect("a run's verdicts are about metrics");
    let map = match &finding.worst {
        Some(worst) => worst.map.clone(),
        None => metric.row().map.name().to_owned(),
    };
    let plane = files.errors.plane(&map)?;
    let (x, y) = match &finding.worst {
        Some(worst) => (worst.x, worst.y),
        None => worst_block(metric, &plane, &scene.truths[&case.alignment].regions),
    };
    Ok(Some(Evidence {
        place: [x, y],
        plane: scene.shelf.plane(&map, Nature::Number, &plane),
        map,
    }))
}
