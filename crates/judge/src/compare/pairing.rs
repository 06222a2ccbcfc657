//! Pairs of cases of two runs.

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

use measure::{Case, CaseId, Error, Run, StoredRun};

/// A case that two runs have.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Case of the first run.
    pub first: &'a Case,
    /// Case of the second run.
    pub second: &'a Case,
}

impl Pair<'_> {
    /// Returns the paths of a file of both cases.
    pub fn files(&self, [first, second]: [&StoredRun; 2], name: &str) -> [PathBuf; 2] {
        [first.file(self.first, name), second.file(self.second, name)]
    }
}

/// Pairs the cases that both runs have, in the order of the first.
pub fn pair_cases<'a>(first: &'a Run, second: &'a Run) -> Vec<Pair<'a>> {
    let partners = find_partners(first, second);
    let pairs = first.cases.iter().zip(partners);
    pairs
        .filter_map(|(first, second)| second.map(|second| Pair { first, second }))
        .collect()
}

/// Lists the cases that `run` lacks and `other` has: `fan / jump_flood:paper`.
pub fn cases_missing_from(run: &Run, other: &Run) -> Vec<String> {
    let cases = other.cases.iter().zip(find_partners(other, run));
    let missing = cases.filter(|(_, partner)| partner.is_none());
    missing
        .map(|(case, _)| format!("{} / {}", case.scene, case.filter_id()))
        .collect()
}

/// Refuses runs with incomparable scores.
pub fn check_comparable(
    first: &StoredRun,
    second: &StoredRun,
    pairs: &[Pair],
) -> Result<(), Error> {
    let refuse = |reason: String| {
        Err(Error::Refused(format!(
            "{}: {reason}",
            second.path.display()
        )))
    };
    let there = first.path.display();
    let [expected, pixels] = [first, second].map(|side| side.run.render.size());
    if pixels != expected {
        return refuse(format!(
            "its pictures have {pixels} pixels, those of {there} {expected}; scores of two sizes do not compare: make one run again \
             at the other's size"
        ));
    }
    if pairs.is_empty() {
        let scenes =
            |side: &StoredRun| names(side.run.cases.iter().map(|case| case.scene.to_string()));
        let filters = |side: &StoredRun| {
            let cases = side.run.cases.iter().filter(|case| !case.is_reference);
            names(cases.map(|case| case.filter.clone()))
        };
        return refuse(format!(
            "it has no case in common with {there}: scenes {} there and {} here, filters {} there and {} here; run the same \
             scenes and filters twice",
            scenes(first),
            scenes(second),
            filters(first),
            filters(second)
        ));
    }
    let differs = |pair: &&Pair| pair.first.truth_hash != pair.second.truth_hash;
    match pairs.iter().find(differs) {
        None => Ok(()),
        Some(Pair { first, .. }) => refuse(format!(
            "its truth of {} ({}) is another than that of {there}: scene, exposure, samples, seed or tracer have changed, and \
             scores against two truths differ for that alone; run both by the same version with the same samples per pixel, \
             replicates, seed and exposure",
            first.scene, first.alignment
        )),
    }
}

/// Finds the partner in `other` of each case of `run`: the same case, or else the only unpaired one
/// of its preset, with overridden parameters.
fn find_partners<'a>(run: &Run, other: &'a Run) -> Vec<Option<&'a Case>> {
    // Of equal cases, the first one counts.
    let cases = other.cases.iter().rev();
    let exact: HashMap<&CaseId, &Case> = cases.map(|case| (&case.id, case)).collect();
    let known: HashSet<&CaseId> = run.cases.iter().map(|case| &case.id).collect();
    let mut counts: HashMap<CaseId, usize> = HashMap::new();
    for case in run
        .cases
        .iter()
        .filter(|case| !exact.contains_key(&case.id))
    {
        *counts.entry(case.of_preset()).or_default() += 1;
    }
    let mut others: HashMap<CaseId, Vec<&Case>> = HashMap::new();
    for case in other.cases.iter().filter(|case| !known.contains(&case.id)) {
        others.entry(case.of_preset()).or_default().push(case);
    }
    let find = |case: &Case| {
        let preset = case.of_preset();
        match others.get(&preset).map(Vec::as_slice) {
            _ if exact.contains_key(&case.id) => Some(exact[&case.id]),
            Some([single]) if counts.get(&preset) == Some(&1) => Some(*single),
            _ => None,
        }
    };
    run.cases.iter().map(find).collect()
}

/// Lists up to six names, each once.
fn names(all: impl Iterator<Item = String>) -> String {
    const MOST: usize = 6;
    let mut once: Vec<String> = Vec::new();
    for name in all {
        if !once.contains(&name) {
            once.push(name);
        }
    }
    let more = once.len().saturating_sub(MOST);
    once.truncate(MOST);
    let text = once.join(", ");
    match more {
        0 => text,
        more => format!("{text} and {more} more"),
    }
}
