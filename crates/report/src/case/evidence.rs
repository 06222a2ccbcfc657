//! Evidence of a bound that is not met: the place to look at, and the map that was searched.

use judge::{Finding, worst_block};
use metrics::Metric;
use suite::{Case, Error};

use crate::pixels::scene_files::{CaseFiles, SceneFiles};

/// The worst place of one score.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// Middle of the block whose error is largest.
    pub place: [u32; 2],
    /// The error map, as errors.exr calls it.
    pub map: String,
    /// Plane of the map.
    pub plane: usize,
}

/// Finds the place to look at; none for a finding that needs no explanation, or is about a sequence. A `check` has looked for the place; after a `run`
/// it is looked for here.
pub fn find_evidence(
    finding: &Finding,
    case: &Case,
    files: &CaseFiles,
    scene: &mut SceneFiles,
) -> Result<Option<Evidence>, Error> {
    if !finding.outcome.is_notable() {
        return Ok(None);
    }
    let metric = finding.metric;
    if let Metric::Sequence(_) = metric {
        return Ok(None);
    }
    let map = match &finding.worst {
        Some(worst) => worst.map.clone(),
        None => metric.row().map.name().to_owned(),
    };
    let plane = files.errors.map(&map)?;
    let (x, y) = match &finding.worst {
        Some(worst) => (worst.x, worst.y),
        None => worst_block(metric, &plane, &scene.truths[&case.alignment].regions),
    };
    Ok(Some(Evidence {
        place: [x, y],
        plane: scene.planes.add(&plane),
        map,
    }))
}
