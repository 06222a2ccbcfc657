//! Pairs of cases of two runs.

use std::collections::HashMap;
use std::path::PathBuf;

use frame::Alignment;
use suite::{Case, Error, Run};

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
    let label = |case: &Case| format!("{} / {}", case.scene, filter_label(case));
    missing.map(label).collect()
}

/// Formats a case's filter: `jump_flood:paper`; a reference picture with its alignment, as each alignment has its own.
pub fn filter_label(case: &Case) -> String {
    match case.is_reference {
        true => format!("{} ({})", case.name(), case.alignment),
        false => case.name(),
    }
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
        let scenes = |side: &Side| names(side.run.cases.iter().map(|case| case.scene.as_str()));
        let filters = |side: &Side| {
            let cases = side.run.cases.iter().filter(|case| !case.is_reference);
            names(cases.map(|case| case.filter.as_str()))
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

/// Key that is unique among the cases of one run.
type Key<'a> = (&'a str, String, Alignment, bool);

fn key(case: &Case) -> Key<'_> {
    (&case.scene, case.name(), case.alignment, case.is_reference)
}

/// Key of a case within a run, whatever values `--set` gave to its parameters.
fn preset_key(case: &Case) -> Key<'_> {
    (
        &case.scene,
        case.preset_name(),
        case.alignment,
        case.is_reference,
    )
}

/// The cases of one run that belong to those of another: the same case, or else the only one of its preset, with parameters of
/// its own.
struct Partners<'a> {
    exact: HashMap<Key<'a>, &'a Case>,
    /// By preset, the cases that are in one run alone; none where there are several.
    own: HashMap<Key<'a>, Option<&'a Case>>,
    other: HashMap<Key<'a>, Option<&'a Case>>,
}

impl<'a> Partners<'a> {
    fn new(run: &'a Run, other: &'a Run) -> Self {
        let exact = index(&other.cases);
        let known = index(&run.cases);
        Self {
            own: single_presets(&run.cases, &exact),
            other: single_presets(&other.cases, &known),
            exact,
        }
    }

    /// Finds the partner of a case of the first run.
    fn find(&self, case: &'a Case) -> Option<&'a Case> {
        if let Some(exact) = self.exact.get(&key(case)) {
            return Some(exact);
        }
        let preset = preset_key(case);
        let is_single = self.own.get(&preset).is_some_and(Option::is_some);
        let other = self.other.get(&preset).copied().flatten();
        other.filter(|_| is_single)
    }
}

/// Indexes cases by their keys.
fn index(cases: &[Case]) -> HashMap<Key<'_>, &Case> {
    let mut index = HashMap::new();
    for case in cases {
        index.entry(key(case)).or_insert(case);
    }
    index
}

/// Finds the only case of each preset among those that are not in an index; none where there are several.
fn single_presets<'a>(
    cases: &'a [Case],
    index: &HashMap<Key, &Case>,
) -> HashMap<Key<'a>, Option<&'a Case>> {
    let mut single = HashMap::new();
    for case in cases.iter().filter(|case| !index.contains_key(&key(case))) {
        (single.entry(preset_key(case)))
            .and_modify(|known| *known = None)
            .or_insert(Some(case));
    }
    single
}

/// Lists names, each once and six at most.
fn names<'a>(all: impl Iterator<Item = &'a str>) -> String {
    const MOST: usize = 6;
    let mut once: Vec<&str> = Vec::new();
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
