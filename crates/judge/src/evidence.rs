//! Evidence of bounds that are not met: the worst place of a picture, and the wrong blur that it resembles most.

use std::path::Path;

use frame::{Image, Ladder, Picture, read_exr};
use metrics::{Reference, Regions};
use store::RenderFile;
use suite::{Case, Error, ErrorMaps, Run};

use crate::decoys::{Decoys, FEW_SUBFRAMES};
use crate::finding::Finding;
use crate::worst::{Worst, worst_block, write_crop};

/// Adds evidence to every notable finding about a single frame of a run, from the run's files below `folder`, and writes a picture of each worst place
/// into its case's folder.
pub fn add_evidence(run: &Run, findings: &mut [Finding], folder: &Path) -> Result<(), Error> {
    let mut notable: Vec<(&Case, Vec<&mut Finding>)> = Vec::new();
    for finding in findings
        .iter_mut()
        .filter(|finding| finding.outcome.is_notable() && !finding.is_of_sequence())
    {
        match notable.last_mut() {
            Some((case, own)) if finding.is_of(case) => own.push(finding),
            _ => {
                let mut cases = run.cases.iter();
                let case = cases.find(|case| !case.is_reference && finding.is_of(case));
                notable.push((case.expect("a finding is about a case"), vec![finding]));
            }
        }
    }
    let truth_of = |case: &Case| (case.scene.clone(), case.alignment);
    for group in notable.chunk_by_mut(|(one, _), (next, _)| truth_of(one) == truth_of(next)) {
        add_evidence_of_truth(group, folder)?;
    }
    Ok(())
}

/// Adds evidence to the findings of cases that have one scene and alignment in common.
fn add_evidence_of_truth(
    cases: &mut [(&Case, Vec<&mut Finding>)],
    folder: &Path,
) -> Result<(), Error> {
    let (first, _) = &cases[0];
    let (frame, truth) = first.read_frame_and_truth(folder)?;
    let rung = RenderFile::Rung(truth.alignment, FEW_SUBFRAMES);
    let rung = first.render_path(folder, rung);
    // An engine may have drawn too few sub-frames for it.
    let few_subframes = match rung.exists() {
        true => Some(Ladder::read_rung(&rung, FEW_SUBFRAMES)?),
        false => None,
    };
    let few_subframes = few_subframes.map(|ladder| Picture::mean(&ladder.rungs[0].halves));
    let reference = Reference::new(&frame, &truth, None, &frame.display.into())?;
    let decoys = Decoys::new(&frame, &truth, few_subframes, &reference)?;
    let places = WorstPlaces {
        regions: &reference.regions,
        truth: &truth.mean().color,
        stops: frame.display.stops,
    };
    for (case, findings) in cases {
        let resembles = decoys.nearest(&case.scores);
        let output = read_exr(&folder.join(&case.folder).join("output.exr"))?.color("")?;
        let errors = ErrorMaps::read(case, folder)?;
        for finding in findings {
            finding.worst = Some(places.show_worst(case, (&output, &errors), finding, folder)?);
            finding.resembles = resembles.clone();
        }
    }
    Ok(())
}

/// Inputs to find and show worst places.
struct WorstPlaces<'a> {
    regions: &'a Regions,
    truth: &'a Image,
    /// Display exposure of pictures, in stops.
    stops: f32,
}

impl WorstPlaces<'_> {
    /// Finds the largest error of a finding's metric, and writes a picture of its place into the case's folder.
    fn show_worst(
        &self,
        case: &Case,
        (output, errors): (&Image, &ErrorMaps),
        finding: &Finding,
        folder: &Path,
    ) -> Result<Worst, Error> {
        let metric = finding.metric;
        let map_name = metric.row().map.name();
        let map = errors.map(map_name)?;
        let (x, y) = worst_block(metric, &map, self.regions);
        let picture = case.folder.join(format!("worst_{metric}.png"));
        let panels = [self.truth, output];
        write_crop(&folder.join(&picture), (x, y), panels, &map, self.stops)?;
        Ok(Worst {
            x,
            y,
            map: map_name.to_owned(),
            picture,
        })
    }
}
