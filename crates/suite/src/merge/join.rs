//! Runs of disjoint cases, joined as one.

use std::collections::HashMap;

use crate::Error;
use crate::merge::case_order::CaseOrder;
use crate::merge::checks::{check_complete, check_truths};
use crate::merge::run_part::RunPart;
use crate::run::case::Case;
use crate::run::failure::Failure;
use crate::run::sequence::Sequence;
use crate::run::{Run, list_run_settings};
use crate::stats::overall::overall;

/// Joins runs; the command is that of the first.
pub(super) fn join_runs(parts: &[RunPart]) -> Result<Run, Error> {
    let Some((first, others)) = parts.split_first() else {
        return Err(Error::Usage(
            "no part is named; name finished runs".to_owned(),
        ));
    };
    for other in others {
        check_settings(first, other)?;
    }
    let adapter = find_adapter(parts)?;
    let mut cases = join(parts, |run| &run.cases, |case| case.of_preset())?;
    check_truths(&cases)?;
    let mut failures = join(parts, |run| &run.failures, text_of)?;
    let mut sequences = join(
        parts,
        |run| &run.sequences,
        |own| (own.scene.clone(), own.filter_id()),
    )?;
    check_complete(&cases, &failures, first.run.common_alignment)?;
    let order = CaseOrder::new(parts);
    cases.sort_by_key(|(case, _)| order.of_case(case));
    failures.sort_by_key(|(failure, _)| order.of_failure(failure));
    sequences.sort_by_key(|(sequence, _)| order.of_sequence(sequence));
    let cases: Vec<Case> = cases.into_iter().map(|(case, _)| case).collect();
    Ok(Run {
        adapter,
        overall: overall(&cases),
        cases,
        sequences: sequences
            .into_iter()
            .map(|(sequence, _)| sequence)
            .collect(),
        failures: failures.into_iter().map(|(failure, _)| failure).collect(),
        ..first.run.clone()
    })
}

/// Refuses a part that was measured in another way than the first.
fn check_settings(first: &RunPart, other: &RunPart) -> Result<(), Error> {
    let all =
        |run: &Run| list_run_settings(&run.program, run.common_alignment, run.frames, &run.render);
    let (one, two) = (all(&first.run), all(&other.run));
    match one.into_iter().zip(two).find(|(one, two)| one != two) {
        None => Ok(()),
        Some(((name, one), (_, two))) => Err(Error::Usage(format!(
            "{} has the {name} {one}, {} has {two}; parts of one run have the same settings{}",
            first.file(),
            other.file(),
            match name {
                "common shutter" => ": give every part the same one",
                _ => "",
            }
        ))),
    }
}

/// Returns the adapter of all parts. A part of programs alone has none, and can stand beside any.
fn find_adapter(parts: &[RunPart]) -> Result<Option<filters::AdapterDescription>, Error> {
    let mut with = parts.iter().filter(|part| part.run.adapter.is_some());
    let Some(first) = with.next() else {
        return Ok(None);
    };
    match with.find(|part| part.run.adapter != first.run.adapter) {
        None => Ok(first.run.adapter.clone()),
        Some(other) => {
            let text = |part: &RunPart| {
                let adapter = part.run.adapter.as_ref().expect("it has one");
                format!("{} with the driver {}", adapter.name, adapter.driver)
            };
            Err(Error::Usage(format!(
                "{} was measured on {}, {} on {}; parts of one run have the same adapter and driver",
                first.file(),
                text(first),
                other.file(),
                text(other)
            )))
        }
    }
}

/// Lists things of all parts, each once, with the part that each comes from. Two of one key must be equal.
fn join<T, K>(
    parts: &[RunPart],
    list: fn(&Run) -> &Vec<T>,
    key: fn(&T) -> K,
) -> Result<Vec<(T, &RunPart)>, Error>
where
    T: Clone + Joined,
    K: std::hash::Hash + Eq,
{
    let mut places: HashMap<K, usize> = HashMap::new();
    let mut all: Vec<(T, &RunPart)> = Vec::new();
    for part in parts {
        for one in list(&part.run) {
            match places.get(&key(one)) {
                None => {
                    places.insert(key(one), all.len());
                    all.push((one.clone(), part));
                }
                Some(place) => {
                    let (other, other_part) = &all[*place];
                    if text_of(other) != text_of(one) {
                        return Err(Error::Usage(format!(
                            "{} and {} hold {} with other numbers; leave out one of them, or measure it again in both, with one \
                             build of the program",
                            other_part.file(),
                            part.file(),
                            one.label()
                        )));
                    }
                }
            }
        }
    }
    Ok(all)
}

/// Something of a run that two parts may both hold.
trait Joined: serde::Serialize {
    /// Names it in errors.
    fn label(&self) -> String;
}

impl Joined for Case {
    fn label(&self) -> String {
        self.id.to_string()
    }
}

impl Joined for Sequence {
    fn label(&self) -> String {
        format!("the sequence {} / {}", self.scene, self.filter)
    }
}

impl Joined for Failure {
    fn label(&self) -> String {
        format!("the failure {} / {}", self.scene, self.filter)
    }
}

fn text_of(one: &impl serde::Serialize) -> String {
    serde_json::to_string(one).expect("a run is plain data")
}
