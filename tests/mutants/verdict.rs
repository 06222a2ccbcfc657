//! Verdict on a mutant: killed by a limit, or the reason why not.

use metrics::Measured;
use suite::Case;
use tracer::SceneId;

use crate::bench::SEED;
use crate::journal::Change;
use crate::limits::find_broken;
use crate::study::Study;
use crate::subject::MutantFilter;

/// Smallest change that a check should notice, in noise floors.
pub const NOTICEABLE: f64 = 3.0;

pub struct Verdict<'s> {
    pub mutant: &'s MutantFilter,
    /// Error of a mutant that makes no picture, which fails a check by itself.
    pub failure: Option<String>,
    /// Largest change of a picture, and its scene; none until every scene was tried.
    pub change: Option<(Change, SceneId)>,
    /// Mean squared error over what moves in that scene, divided by the unchanged filter's.
    pub error: Option<f64>,
    /// First scene with broken limits, and their metrics.
    pub killed: Option<(SceneId, Vec<String>)>,
    /// True if every scene was tried, or a limit broke.
    pub is_decided: bool,
    /// Metrics that would notice a survivor if they had limits, each with a scene.
    pub noticed_by: Vec<(String, SceneId)>,
}

/// Reason why no limit kills a mutant, by the size of its change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// More than three noise floors: a limit is missing or too loose, or a scene is missing.
    Hole,
    /// More than three noise floors, but without a larger squared error where the change is largest.
    NoWorse,
    /// One to three noise floors.
    Small,
    /// Less than one noise floor.
    Unseen,
    /// The same pictures, to the last bit.
    Equivalent,
}

/// Columns of the table: sizes of changes.
pub const SIZES: [&str; 4] = ["same", "below 1", "1 to 3", "above 3"];

impl Reason {
    #[rustfmt::skip]
    pub const ALL: [Self; 5] =
        [Self::Hole, Self::NoWorse, Self::Small, Self::Unseen, Self::Equivalent];

    /// Returns the column of the table, and the title of a list of survivors.
    pub fn names(self) -> [&'static str; 2] {
        let [same, unseen, small, noticeable] = SIZES;
        match self {
            Self::Hole => [
                noticeable,
                "holes: more than three noise floors, and no limit breaks",
            ],
            Self::NoWorse => [
                noticeable,
                "no worse: more than three noise floors, but the squared error does not grow",
            ],
            Self::Small => [small, "below the noise: one to three noise floors"],
            Self::Unseen => [unseen, "below the noise: less than one noise floor"],
            Self::Equivalent => [same, "equivalent: the same pictures to the last bit"],
        }
    }
}

impl Verdict<'_> {
    /// Returns whether a mutant broke a limit on a scene, or made no picture.
    pub fn is_killed(&self) -> bool {
        self.killed.is_some() || self.failure.is_some()
    }

    /// Returns the reason why a survivor survives; none if its change is not known.
    pub fn reason(&self) -> Option<Reason> {
        let (change, _) = self.change.as_ref()?;
        Some(match change.floors {
            _ if change.share == 0.0 => Reason::Equivalent,
            floors if floors < 1.0 => Reason::Unseen,
            floors if floors <= NOTICEABLE => Reason::Small,
            _ if self.error.is_some_and(|error| error <= 1.0) => Reason::NoWorse,
            _ => Reason::Hole,
        })
    }
}

impl<'s> Study<'_, 's> {
    pub fn find_verdicts(&self) -> Vec<Verdict<'s>> {
        let mutants = self.subject.mutants.iter();
        mutants.map(|mutant| self.find_verdict(mutant)).collect()
    }

    pub fn find_verdict(&self, mutant: &'s MutantFilter) -> Verdict<'s> {
        let mut verdict = Verdict {
            mutant,
            failure: None,
            change: None,
            error: None,
            killed: None,
            is_decided: true,
            noticed_by: Vec::new(),
        };
        let mut is_tried = true;
        for scene in self.bench.scenes.iter().map(|scene| &scene.id) {
            let place = self.subject.place(&mutant.name, scene);
            match self.journal.changes.get(&place) {
                None => is_tried = false,
                Some(Err(reason)) => verdict.failure = Some(reason.clone()),
                Some(Ok(change)) => {
                    let largest = verdict.change.as_ref();
                    if largest.is_none_or(|(largest, _)| largest.floors < change.floors) {
                        verdict.change = Some((*change, scene.clone()));
                    }
                }
            }
            match self.journal.cases.get(&place) {
                None => verdict.is_decided &= self.journal.is_same_picture(&place),
                Some(Err(reason)) => verdict.failure = Some(reason.clone()),
                Some(Ok(case)) => {
                    let limits = &self.limits[scene];
                    let broken = find_broken(case, &limits.deciding);
                    if !broken.is_empty() && verdict.killed.is_none() {
                        verdict.killed = Some((scene.clone(), broken));
                    }
                    let widest = limits.widest.iter();
                    let noticed = widest.flat_map(|widest| find_broken(case, widest));
                    (verdict.noticed_by).extend(noticed.map(|metric| (metric, scene.clone())));
                }
            }
        }
        verdict.change.take_if(|_| !is_tried);
        let largest = verdict.change.as_ref();
        verdict.error = largest.and_then(|(_, scene)| self.find_error(mutant, scene));
        verdict.is_decided |= verdict.is_killed();
        verdict
    }

    /// Divides the mean squared error of a mutant by the unchanged filter's.
    fn find_error(&self, mutant: &MutantFilter, scene: &SceneId) -> Option<f64> {
        let (subject, journal) = (self.subject, &self.journal);
        let sound = journal.sound.get(&subject.sound_place(scene, SEED))?;
        let case = journal.cases.get(&subject.place(&mutant.name, scene))?;
        let error = |case: &Case| match case.scores.get("mse_moving".parse().ok()?) {
            Measured::Score(score) => Some(score.value),
            Measured::NotApplicable { .. } => None,
        };
        Some(error(case.as_ref().ok()?)? / error(sound.cases.first()?)?)
    }
}
