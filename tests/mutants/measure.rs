//! Scores of mutants, measured until a limit kills them.

use std::collections::BTreeMap;
use std::fs;

use suite::{Case, Error, FilterChoice, Run};
use tracer::Scene;

use crate::bench::{Bench, SEED};
use crate::journal::Journal;
use crate::limits::{Limits, SceneLimits, refuse_broken};
use crate::subject::{MutantFilter, Subject};
use crate::verdict::{is_killed, is_same_picture};

/// Mutants that are measured before the journal gets their scores.
const BATCH: usize = 16;

const SOUND: &str = "sound";

/// Measures every mutant of a filter on one scene after the other, the one that it changes most first, until a limit kills it.
pub fn measure_mutants(
    bench: &mut Bench,
    subject: &Subject,
    limits: &Limits,
    journal: &mut Journal,
    due: &dyn Fn() -> bool,
) -> Result<(), Error> {
    let scenes = bench.scenes.iter().map(|choice| choice.scene.clone());
    let scenes: Vec<Scene> = scenes.collect();
    loop {
        let mut groups: BTreeMap<usize, Vec<&MutantFilter>> = BTreeMap::new();
        for mutant in find_alive(bench, subject, limits, journal) {
            let change = |at: &usize| {
                let place = subject.place(&mutant.name, &scenes[*at].id);
                let found = journal.changes.get(&place).and_then(|it| it.as_ref().ok());
                found.map_or(0.0, |change| change.floors)
            };
            let missing =
                (0..scenes.len()).filter(|at| is_missing(subject, mutant, &scenes[*at], journal));
            if let Some(at) = missing.max_by(|a, b| change(a).total_cmp(&change(b))) {
                groups.entry(at).or_default().push(mutant);
            }
        }
        if groups.is_empty() {
            return Ok(());
        }
        for (at, mutants) in groups {
            for batch in mutants.chunks(BATCH) {
                if !due() {
                    return Ok(());
                }
                let scene = &scenes[at];
                eprintln!("{}: {} mutants of {}", scene.id, batch.len(), subject.name);
                measure_batch(bench, subject, scene, &limits[&scene.id], batch, journal)?;
            }
        }
    }
}

fn find_alive<'s>(
    bench: &Bench,
    subject: &'s Subject,
    limits: &Limits,
    journal: &Journal,
) -> Vec<&'s MutantFilter> {
    (subject.mutants.iter())
        .filter(|mutant| !is_killed(bench, subject, limits, journal, mutant))
        .collect()
}

/// Tells whether the scores of a mutant on a scene are missing. Those of the same picture are known.
fn is_missing(subject: &Subject, mutant: &MutantFilter, scene: &Scene, journal: &Journal) -> bool {
    let place = subject.place(&mutant.name, &scene.id);
    journal.cases.get(&place).is_none() && !is_same_picture(journal, &place)
}

/// Measures some mutants on a scene, one by one if they fail together. The filter without a change is measured with the first.
fn measure_batch(
    bench: &mut Bench,
    subject: &Subject,
    scene: &Scene,
    limits: &SceneLimits,
    batch: &[&MutantFilter],
    journal: &mut Journal,
) -> Result<(), Error> {
    // Cases and failures name filter and preset, which are the same in all mutants.
    let label = |at: usize| format!("mutant_{at}");
    let sound = subject.sound_place(&scene.id, SEED);
    let is_new = journal.sound.get(&sound).is_none();
    let mutants = batch.iter().map(|mutant| &mutant.choice);
    let filters = (mutants.enumerate())
        .map(|(at, choice)| (label(at), choice))
        .chain(is_new.then(|| (SOUND.to_owned(), &subject.sound)))
        .map(|(preset, choice)| FilterChoice {
            preset,
            ..choice.clone()
        });
    let run = match bench.measure(scene, filters.collect(), SEED) {
        Ok(run) => run,
        Err(error @ Error::Filter(_)) => {
            bench.reopen_gpu();
            if let [mutant] = batch {
                let place = subject.place(&mutant.name, &scene.id);
                journal.cases.add(place, Err(error.to_string()));
                return Ok(());
            }
            return (batch.chunks(1))
                .try_for_each(|one| measure_batch(bench, subject, scene, limits, one, journal));
        }
        Err(error) => return Err(error),
    };
    if is_new {
        let case = take_case(bench, subject, &run, SOUND).map_err(Error::Usage)?;
        refuse_broken(subject, &case, limits)?;
        let cases = vec![case];
        journal.sound.add(
            sound,
            Run {
                cases,
                ..run.clone()
            },
        );
    }
    for (at, mutant) in batch.iter().enumerate() {
        let case = take_case(bench, subject, &run, &label(at)).map(Box::new);
        let place = subject.place(&mutant.name, &scene.id);
        journal.cases.add(place, case);
    }
    Ok(())
}

/// Takes the case with a label out of a run, or the reason why it failed, and gives it the preset's name. Removes its pictures, which
/// nobody looks at again.
fn take_case(bench: &Bench, subject: &Subject, run: &Run, label: &str) -> Result<Case, String> {
    let Some(case) = run.cases.iter().find(|case| case.preset == label) else {
        let name = format!("{}:{label}", subject.sound.filter.name);
        let failure = run.failures.iter().find(|failure| failure.filter == name);
        let failure = failure.expect("every case is measured or fails");
        return Err(failure.reason.clone());
    };
    // A folder that stays is no harm.
    let _ = fs::remove_dir_all(bench.truths(SEED).join(&case.folder));
    let mut case = case.clone();
    case.id.preset = subject.sound.preset.clone();
    Ok(case)
}
