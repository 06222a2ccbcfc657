//! Cases that no single process could have measured together, and are refused.

use std::collections::{BTreeSet, HashMap};

use frame::Alignment;
use tracer::SceneId;

use crate::Error;
use crate::identity::FilterId;
use crate::merge::run_part::RunPart;
use crate::run::case::Case;
use crate::run::failure::Failure;

/// Refuses two cases of one scene and shutter that were measured against different truths, or with different exposures.
pub(super) fn check_truths(cases: &[(Case, &RunPart)]) -> Result<(), Error> {
    let mut truths: HashMap<(&SceneId, Alignment), &(Case, &RunPart)> = HashMap::new();
    let mut exposures: HashMap<&SceneId, &(Case, &RunPart)> = HashMap::new();
    for found in cases {
        let (case, part) = found;
        let (first, first_part) = truths.entry((&case.scene, case.alignment)).or_insert(found);
        let (exposed, _) = exposures.entry(&case.scene).or_insert(found);
        if first.truth_hash != case.truth_hash || exposed.exposure != case.exposure {
            return Err(Error::Usage(format!(
                "{} and {} measured {} against different truths ({} shutter, {} and {}); parts of one run have the same scenes, \
                 exposures and program",
                first_part.file(),
                part.file(),
                case.scene,
                case.alignment,
                first.truth_hash,
                case.truth_hash
            )));
        }
    }
    Ok(())
}

/// Refuses cases that no process could have measured together: scenes with different filters, and shutters without references.
pub(super) fn check_complete(
    cases: &[(Case, &RunPart)],
    failures: &[(Failure, &RunPart)],
    common: Alignment,
) -> Result<(), Error> {
    // What an engine drew has one shutter, and leaves out filters of others.
    let rendered = || {
        cases
            .iter()
            .map(|(case, _)| case)
            .filter(|case| case.drawn.is_none())
    };
    let scenes: BTreeSet<&SceneId> = rendered().map(|case| &case.scene).collect();
    let names: BTreeSet<FilterId> = rendered().map(|case| case.filter_id()).collect();
    let found: BTreeSet<(&SceneId, FilterId)> = rendered()
        .map(|case| (&case.scene, case.filter_id()))
        .chain(
            failures
                .iter()
                .map(|(failure, _)| (&failure.scene, failure.filter_id())),
        )
        .collect();
    let has_references = |alignment: &Alignment| {
        (names.iter()).any(|name| name.is_reference && name.alignment == *alignment)
    };
    let shutters = names.iter().filter(|name| !name.is_reference);
    let shutters: BTreeSet<Alignment> = (shutters.map(|name| name.alignment))
        .chain((!names.is_empty()).then_some(common))
        .collect();
    if let Some(missing) = shutters.iter().find(|alignment| !has_references(alignment)) {
        return Err(Error::Usage(format!(
            "no part holds the references of the {missing} shutter; add the part with the references, measured with the same \
             filters"
        )));
    }
    let mut all = (scenes.iter()).flat_map(|scene| names.iter().map(|name| (*scene, name.clone())));
    if let Some((scene, missing)) = all.find(|one| !found.contains(one)) {
        return Err(Error::Usage(format!(
            "no part holds {scene} / {} ({} shutter), which other scenes have; add the part that measured it",
            missing.name, missing.alignment
        )));
    }
    Ok(())
}
