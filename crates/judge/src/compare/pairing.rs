//! Pairs of cases of two runs.

use std::collections::HashMap;
use std::path::PathBuf;

use suite::{Case, CaseId, Error, Run};

use crate::compare::side::Side;

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
    pub fn files(&self, [first, second]: [&Side; 2], name: &str) -> [PathBuf; 2] {
        [first.file(self.first, name), second.file(self.second, name)]
    }
}

/// Pairs the cases that both runs have, in the order of the first.
pub fn pair_cases<'a>(first: &'a Run, second: &'a Run) -> Vec<Pair<'a>> {
    let partners = Partners::new(first, second);
    let pair = |first| {
        Some(Pair {
            first,
            second: partners.find(first)?,
        })
    };
    first.cases.iter().filter_map(pair).collect()
}

/// Lists the cases that `run` lacks and `other` has: `fan / jump_flood:paper`.
pub fn cases_missing_from(run: &Run, other: &Run) -> Vec<String> {
    let partners = Partners::new(other, run);
    let missing = (other.cases.iter()).filter(|case| partners.find(case).is_none());
    let label = |case: &Case| format!("{} / {}", case.scene, case.filter_id());
    missing.map(label).collect()
}

/// Refuses runs whose scores do not compare.
pub fn check_comparable(first: &Side, second: &Side, pairs: &[Pair]) -> Result<(), Error> {
    let refuse = |reason: String| Err(Error::Usage(format!("{}: {reason}", second.path.display())));
    let there = first.path.display();
    let size = |side: &Side| format!("{}x{}", side.run.render.width, side.run.render.height);
    let [expected, found] = [first, second].map(size);
    if found != expected {
        return refuse(format!(
            "its pictures have {found} pixels, those of {there} {expected}; scores of two sizes do not compare: make one run again \
             at the other's size"
        ));
    }
    if pairs.is_empty() {
        let scenes = |side: &Side| names(side.run.cases.iter().map(|case| case.scene.to_string()));
        let filters = |side: &Side| {
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

/// The cases of one run that belong to those of another: the same case, or else the only one of its preset, with parameters of
/// its own.
struct Partners<'a> {
    exact: HashMap<&'a CaseId, &'a Case>,
    /// By preset, the cases that are in one run alone; none where there are several.
    own: HashMap<CaseId, Option<&'a Case>>,
    other: HashMap<CaseId, Option<&'a Case>>,
}

impl<'a> Partners<'a> {
    fn new(run: &'a Run, other: &'a Run) -> Self {
        let [known, exact] = [run, other].map(|run| {
            let cases = run.cases.iter().rev();
            cases.map(|case| (&case.id, case)).collect()
        });
        Self {
            own: single_presets(&run.cases, &exact),
            other: single_presets(&other.cases, &known),
            exact,
        }
    }

    /// Finds the partner of a case of the first run.
    fn find(&self, case: &'a Case) -> Option<&'a Case> {
        if let Some(exact) = self.exact.get(&case.id) {
            return Some(exact);
        }
        let preset = case.of_preset();
        let is_single = self.own.get(&preset).is_some_and(Option::is_some);
        let other = self.other.get(&preset).copied().flatten();
        other.filter(|_| is_single)
    }
}

/// Finds the only case of each preset among those that are not in an index; none where there are several.
fn single_presets<'a>(
    cases: &'a [Case],
    index: &HashMap<&CaseId, &Case>,
) -> HashMap<CaseId, Option<&'a Case>> {
    let mut single = HashMap::new();
    for case in cases.iter().filter(|case| !index.contains_key(&case.id)) {
        (single.entry(case.of_preset()))
            .and_modify(|known| *known = None)
            .or_insert(Some(case));
    }
    single
}

/// Lists names, each once and six at most.
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
