//! Fold of runs: each case, sequence and failure once, in the order of a single process.

mod order;

use std::collections::HashMap;

use scene::SceneId;
use serde::Serialize;

use self::order::Order;
use crate::Error;
use crate::identity::FilterId;
use crate::run::Run;
use crate::run::case::Case;
use crate::run::failure::Failure;
use crate::run::sequence::Sequence;
use crate::run::stored::StoredRun;
use crate::stats::overall::overall;

/// Folds at least one run; keeps the first one's command.
///
/// # Errors
/// Two runs differ in their settings or adapters, or have different scores for one case.
pub fn fold_runs(parts: &[StoredRun]) -> Result<Run, Error> {
    let first = &parts[0];
    let mut with_adapter = parts.iter().filter(|part| part.run.adapter.is_some());
    let adapted = with_adapter.next().unwrap_or(first);
    for other in parts {
        check_settings(first, other)?;
        check_settings(adapted, other)?;
    }
    let of_preset = |case: &Case| (case.scene.clone(), case.of_preset().filter_id());
    let mut cases = list_once(parts, |run| &run.cases, of_preset)?;
    let of_sequence = |sequence: &Sequence| (sequence.scene.clone(), sequence.filter.clone());
    let mut sequences = list_once(parts, |run| &run.sequences, of_sequence)?;
    let failures = parts.iter().flat_map(|part| &part.run.failures);
    let mut failures: Vec<Failure> = failures.cloned().collect();
    let order = Order::new(parts.iter().map(|part| &part.run));
    cases.sort_by_cached_key(|case| (order.scene(&case.scene), order.filter(&case.filter_id())));
    sequences.sort_by_cached_key(|sequence| {
        (
            order.scene(&sequence.scene),
            sequence.alignment,
            order.filter(&sequence.filter),
        )
    });
    failures.sort_by_cached_key(|failure| {
        let place = (
            order.scene(&failure.scene),
            order.filter(&failure.filter_id()),
        );
        (place, failure.reason.clone())
    });
    failures.dedup();
    Ok(Run {
        adapter: adapted.run.adapter.clone(),
        overall: overall(&cases),
        cases,
        sequences,
        failures,
        ..first.run.clone()
    })
}

/// Refuses a part that was measured in another way than another.
fn check_settings(one: &StoredRun, other: &StoredRun) -> Result<(), Error> {
    match one.run.find_difference(&other.run) {
        None => Ok(()),
        Some((setting, value, other_value)) => Err(Error::Refused(format!(
            "{} has the {setting} {value}, {} has {other_value}; all parts of a run have the same {setting}",
            one.path.display(),
            other.path.display()
        ))),
    }
}

/// Lists each item of all parts once. Two items of one scene and filter must be equal.
fn list_once<T: Clone + Serialize>(
    parts: &[StoredRun],
    list: fn(&Run) -> &Vec<T>,
    key: impl Fn(&T) -> (SceneId, FilterId),
) -> Result<Vec<T>, Error> {
    let mut holders: HashMap<(SceneId, FilterId), (&T, &StoredRun)> = HashMap::new();
    let mut all = Vec::new();
    for part in parts {
        for one in list(&part.run) {
            let key = key(one);
            let Some((other, other_part)) = holders.get(&key) else {
                holders.insert(key, (one, part));
                all.push(one.clone());
                continue;
            };
            if json(*other) != json(one) {
                let (scene, filter) = key;
                return Err(Error::Refused(format!(
                    "{} and {} hold {scene} / {filter} with other numbers; leave out one of them, or measure it again in both, with \
                     one build of the program",
                    other_part.path.display(),
                    part.path.display()
                )));
            }
        }
    }
    Ok(all)
}

fn json(one: &impl Serialize) -> String {
    serde_json::to_string(one).expect("a run is plain data")
}
