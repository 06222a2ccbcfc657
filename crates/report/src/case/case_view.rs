//! Data of a case's section, read from the run's files.

use judge::{BLOCK, Finding, worst_block};
use measure::{Case, Error, Run};
use metrics::Metric;

use super::profile::{Profile, trace_profile, worst_pixel};
use crate::pixels::scene_files::{CaseFiles, Layers, SceneFiles};

/// A case with all that a page shows of its files.
pub struct CaseView<'a> {
    pub run: &'a Run,
    /// Number of the case in the run.
    pub index: usize,
    pub case: &'a Case,
    /// Findings, one per bound; none if the run was not judged.
    pub findings: Vec<&'a Finding>,
    /// Place to look at, per finding; none if it needs no explanation.
    pub evidence: Vec<Option<Evidence>>,
    /// Number of the scene in the run.
    pub scene: usize,
    pub layers: Layers,
    /// Plane of the objects' indices.
    pub objects: usize,
    pub names: Vec<String>,
    /// Display exposure of the scene, in stops.
    pub stops: f32,
    /// Brightness along the motion through the worst place.
    pub profile: Profile,
}

impl<'a> CaseView<'a> {
    /// Reads the files of a case from its number in the run, its scene's number, and the findings
    /// about the scene.
    pub fn read(
        run: &'a Run,
        index: usize,
        scene: usize,
        findings: &[&'a Finding],
        files: &mut SceneFiles,
    ) -> Result<Self, Error> {
        let case = &run.cases[index];
        let measured = files.read_case(case)?;
        let name = case.name();
        let is_about = |finding: &&&Finding| !case.is_reference && finding.filter == name;
        let findings: Vec<&Finding> = findings.iter().filter(is_about).copied().collect();
        let evidence: Vec<Option<Evidence>> = (findings.iter())
            .map(|finding| find_evidence(finding, case, &measured, files))
            .collect::<Result<_, _>>()?;
        let flip = measured.errors.map("flip")?;
        let place = match evidence.iter().flatten().next() {
            Some(first) => worst_pixel(&measured.errors.map(&first.map)?, first.place, BLOCK),
            None => {
                let (x, y) =
                    worst_block(Metric::FLIP, &flip, &files.truths[&case.alignment].regions);
                worst_pixel(&flip, [x, y], BLOCK)
            }
        };
        Ok(Self {
            profile: trace_profile(place, case, files, &measured),
            names: files.frame.objects.clone(),
            stops: files.frame.display.stops,
            layers: measured.layers,
            objects: files.objects,
            run,
            index,
            case,
            findings,
            evidence,
            scene,
        })
    }
}

/// The worst place of one score.
pub struct Evidence {
    /// Middle of the block with the largest error.
    pub place: [u32; 2],
    /// The error map, as named in errors.exr.
    pub map: String,
    pub plane: usize,
}

/// Finds the place to look at; none for a finding that needs no explanation, or is about a
/// sequence. `check` has already found the place; after `run` it is found here.
fn find_evidence(
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
