//! Evidence for bounds that are not met: the worst place of a picture, and the wrong blur most like
//! it.

use std::path::Path;

use frame::{Ladder, read_attribute, read_exr};
use measure::{Case, Error, ErrorMaps, RenderFile, Run, SHARP};
use metrics::Reference;

use crate::decoys::{Decoys, FEW_SUBFRAMES};
use crate::finding::Finding;
use crate::worst::{Worst, worst_block, write_crop};

/// Adds evidence to every notable finding about a single frame of a run, from the run's files below
/// `folder`, and writes a picture of each worst place into its case's folder.
pub fn add_evidence(run: &Run, findings: &mut [Finding], folder: &Path) -> Result<(), Error> {
    let is_of_one = |a: &Finding, b: &Finding| a.scene == b.scene && a.filter == b.filter;
    let cases = findings.chunk_by_mut(is_of_one).filter_map(|group| {
        let is_notable =
            |finding: &&mut Finding| finding.outcome.is_notable() && !finding.is_of_sequence();
        let notable: Vec<&mut Finding> = group.iter_mut().filter(is_notable).collect();
        let is_own = |case: &&Case| !case.is_reference && notable[0].is_of(case);
        let case = (!notable.is_empty()).then(|| run.cases.iter().find(is_own))?;
        Some((case.expect("a finding is about a case"), notable))
    });
    let mut cases: Vec<(&Case, Vec<&mut Finding>)> = cases.collect();
    let truth_of = |case: &Case| (case.scene.clone(), case.alignment);
    for group in cases.chunk_by_mut(|(one, _), (next, _)| truth_of(one) == truth_of(next)) {
        add_evidence_of_truth(group, folder)?;
    }
    Ok(())
}

/// Adds evidence to the findings of cases with the same scene and alignment.
fn add_evidence_of_truth(
    cases: &mut [(&Case, Vec<&mut Finding>)],
    folder: &Path,
) -> Result<(), Error> {
    let (first, _) = &cases[0];
    let (frame, truth) = first.read_frame_and_truth(folder)?;
    let rung = |count| first.render_path(folder, RenderFile::Rung(truth.alignment, count));
    let file = rung(FEW_SUBFRAMES);
    // A check renders only the first rung: this one may be of an earlier truth, or missing because
    // an engine drew too few sub-frames.
    let hash = |file: &Path| read_attribute(file, "content_hash");
    let few_subframes = if file.exists() && hash(&file) == hash(&rung(SHARP)) {
        Some(Ladder::read_rung(&file, FEW_SUBFRAMES)?)
    } else {
        None
    };
    let mean = truth.mean();
    let few_subframes = few_subframes.map(|ladder| ladder.rungs[0].picture(&mean));
    let reference = Reference::new(&frame, &truth, None, &frame.display.into())?;
    let decoys = Decoys::new(&frame, &truth, few_subframes, &reference)?;
    let truth = mean.color;
    for (case, findings) in cases {
        let output = read_exr(&folder.join(&case.folder).join("output.exr"))?.color("")?;
        let resembles = decoys.nearest(&case.scores, &output);
        let errors = ErrorMaps::read(case, folder)?;
        for finding in findings {
            let metric = finding.metric;
            let map_name = metric.row().map.name();
            let map = errors.map(map_name)?;
            let (x, y) = worst_block(metric, &map, &reference.regions);
            let picture = case.folder.join(format!("worst_{metric}.png"));
            let path = folder.join(&picture);
            write_crop(&path, (x, y), [&truth, &output], &map, frame.display.stops)?;
            finding.worst = Some(Worst {
                x,
                y,
                map: map_name.to_owned(),
                picture,
            });
            finding.resembles = resembles.clone();
        }
    }
    Ok(())
}
