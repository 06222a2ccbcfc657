//! Cases that no single process could have measured together, and are refused.

use std::collections::{BTreeSet, HashMap};

use frame::Alignment;

use crate::Error;
use crate::merge::run_part::RunPart;
use crate::run::case::Case;
use crate::run::failure::Failure;

/// Refuses two cases of one scene and shutter that were measured against different truths, or with different exposures.
pub(super) fn check_truths(cases: &[(Case, &RunPart)]) -> Result<(), Error> {
    let mut truths: HashMap<(&str, Alignment), &(Case, &RunPart)> = HashMap::new();
    let mut exposures: HashMap<&str, &(Case, &RunPart)> = HashMap::new();
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
    let scenes: BTreeSet<&str> = rendered().map(|case| case.scene.as_str()).collect();
    let mut names: BTreeSet<(bool, String, Alignment)> = BTreeSet::new();
    let mut found: BTreeSet<(&str, bool, String, Alignment)> = BTreeSet::new();
    for case in rendered() {
        names.insert((case.is_reference, case.name(), case.alignment));
        found.insert((&case.scene, case.is_reference, case.name(), case.alignment));
    }
    for (failure, _) in failures {
        found.insert((
            &failure.scene,
            false,
            failure.filter.clone(),
            failure.alignment,
        ));
    }
    let has_references =
        |alignment: Alignment| names.iter().any(|name| name.0 && name.2 == alignment);
    let shutters = names.iter().filter(|name| !name.0).map(|name| name.2);
    let shutters: BTreeSet<Alignment> = shutters
        .chain((!names.is_empty()).then_some(common))
        .collect();
    if let Some(missing) = shutters
        .into_iter()
        .find(|alignment| !has_references(*alignment))
    {
        return Err(Error::Usage(format!(
            "no part holds the references of the {missing} shutter; add the part that `shuttertruth run --part references` writes \
             with the same filters"
        )));
    }
    for scene in &scenes {
        for (is_reference, name, alignment) in &names {
            if !found.contains(&(scene, *is_reference, name.clone(), *alignment)) {
                return Err(Error::Usage(format!(
                    "no part holds {scene} / {name} ({alignment} shutter), which other scenes have; add the part that measured it"
                )));
            }
        }
    }
    Ok(())
}
