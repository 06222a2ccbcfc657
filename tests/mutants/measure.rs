//! Scores of mutants, measured until a limit kills them.

use std::collections::BTreeMap;
use std::fs;

use suite::{Case, Error, FilterChoice, Run};
use tracer::Scene;

use crate::bench::SEED;
use crate::study::Study;
use crate::subject::MutantFilter;

/// Mutants that are measured before the journal gets their scores.
const BATCH: usize = 16;

const SOUND: &str = "sound";

impl Study<'_, '_> {
    /// Measures every mutant on each scene in turn, beginning with its largest change, until a limit kills it.
    pub fn measure_mutants(&mut self) -> Result<(), Error> {
        let scenes = self.bench.scenes.clone();
        loop {
            let mut groups: BTreeMap<usize, Vec<&MutantFilter>> = BTreeMap::new();
            for mutant in &self.subject.mutants {
                let change = |at: &usize| {
                    let place = self.subject.place(&mutant.name, &scenes[*at].id);
                    let found = self.journal.changes.get(&place);
                    let change = found.and_then(|found| found.as_ref().ok());
                    change.map_or(0.0, |change| change.floors)
                };
                let missing =
                    (0..scenes.len()).filter(|at| self.lacks_scores(mutant, &scenes[*at]));
                let largest = missing.max_by(|a, b| change(a).total_cmp(&change(b)));
                if let Some(at) = largest.filter(|_| !self.find_verdict(mutant).is_killed()) {
                    groups.entry(at).or_default().push(mutant);
                }
            }
            if groups.is_empty() {
                return Ok(());
            }
            for (at, mutants) in groups {
                for batch in mutants.chunks(BATCH) {
                    if !(self.due)() {
                        return Ok(());
                    }
                    let (scene, name) = (&scenes[at], &self.subject.name);
                    eprintln!("{}: {} mutants of {name}", scene.id, batch.len());
                    self.measure_batch(scene, batch)?;
                }
            }
        }
    }

    /// Returns whether the scores of a mutant on a scene are missing. Scores of an unchanged picture are known.
    fn lacks_scores(&self, mutant: &MutantFilter, scene: &Scene) -> bool {
        let place = self.subject.place(&mutant.name, &scene.id);
        self.journal.cases.get(&place).is_none() && !self.journal.is_same_picture(&place)
    }

    /// Measures some mutants on a scene, one by one if they fail together. The unchanged filter is measured with the first.
    fn measure_batch(&mut self, scene: &Scene, batch: &[&MutantFilter]) -> Result<(), Error> {
        let subject = self.subject;
        // Cases and failures name filter and preset, which are the same in all mutants.
        let label = |at: usize| format!("mutant_{at}");
        let sound = subject.sound_place(&scene.id, SEED);
        let is_new = self.journal.sound.get(&sound).is_none();
        let mutants = batch.iter().map(|mutant| &mutant.choice);
        let filters = (mutants.enumerate())
            .map(|(at, choice)| (label(at), choice))
            .chain(is_new.then(|| (SOUND.to_owned(), &subject.sound)))
            .map(|(preset, choice)| FilterChoice {
                preset,
                ..choice.clone()
            });
        let run = match self.bench.measure(scene, filters.collect(), SEED) {
            Ok(run) => run,
            Err(error @ Error::Filter(_)) => {
                self.bench.reopen_gpu();
                if let [mutant] = batch {
                    let place = subject.place(&mutant.name, &scene.id);
                    self.journal.cases.add(place, Err(error.to_string()));
                    return Ok(());
                }
                let mut alone = batch.chunks(1);
                return alone.try_for_each(|one| self.measure_batch(scene, one));
            }
            Err(error) => return Err(error),
        };
        if is_new {
            let case = self.take_case(&run, SOUND).map_err(Error::Usage)?;
            self.refuse_broken(&case)?;
            let mut alone = run.clone();
            alone.cases = vec![case];
            self.journal.sound.add(sound, alone);
        }
        for (at, mutant) in batch.iter().enumerate() {
            let case = self.take_case(&run, &label(at)).map(Box::new);
            let place = subject.place(&mutant.name, &scene.id);
            self.journal.cases.add(place, case);
        }
        Ok(())
    }

    /// Removes the case with a label from a run, or returns the reason for its failure, and gives it the preset's name. Removes its
    /// pictures, which are not needed again.
    fn take_case(&self, run: &Run, label: &str) -> Result<Case, String> {
        let Some(case) = run.cases.iter().find(|case| case.preset == label) else {
            let name = format!("{}:{label}", self.subject.sound.filter.name);
            let failure = run.failures.iter().find(|failure| failure.filter == name);
            let failure = failure.expect("every case is measured or fails");
            return Err(failure.reason.clone());
        };
        // A leftover folder is harmless.
        let _ = fs::remove_dir_all(self.bench.truths(SEED).join(&case.folder));
        let mut case = case.clone();
        case.id.preset = self.subject.sound.preset.clone();
        Ok(case)
    }
}
