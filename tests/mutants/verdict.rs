//! Verdict on a mutant: killed by a limit, or why not.

use metrics::Measured;
use suite::Case;
use tracer::SceneId;

use crate::bench::{Bench, SEED};
use crate::journal::{Change, Journal, Place};
use crate::limits::{Limits, find_broken};
use crate::subject::{MutantFilter, Subject};

/// Change from which on a mutant is to be noticed, in noise floors.
pub const NOTICEABLE: f64 = 3.0;

pub struct Verdict<'s> {
    pub mutant: &'s MutantFilter,
    /// Error of a mutant that makes no picture, on which a check fails by itself.
    pub failure: Option<String>,
    /// Largest change of a picture, and its scene; none as long as a scene was not tried.
    pub change: Option<(Change, SceneId)>,
    /// Mean squared error over what moves in that scene, divided by that of the filter without a change.
    pub error: Option<f64>,
    /// First scene on which limits are broken, and their metrics.
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
    /// More than three noise floors, but no larger squared error comes of it where the change is largest.
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

/// Tells whether a mutant makes the same picture of a scene as the filter without a change.
pub fn is_same_picture(journal: &Journal, place: &Place) -> bool {
    matches!(journal.changes.get(place), Some(Ok(change)) if change.share == 0.0)
}

/// Tells whether a mutant broke a limit on a scene, or made no picture.
pub fn is_killed(
    bench: &Bench,
    subject: &Subject,
    limits: &Limits,
    journal: &Journal,
    mutant: &MutantFilter,
) -> bool {
    let verdict = find_verdict(bench, subject, limits, journal, mutant);
    verdict.killed.is_some() || verdict.failure.is_some()
}

pub fn find_verdicts<'s>(
    bench: &Bench,
    subject: &'s Subject,
    limits: &Limits,
    journal: &Journal,
) -> Vec<Verdict<'s>> {
    let mutants = subject.mutants.iter();
    mutants
        .map(|mutant| find_verdict(bench, subject, limits, journal, mutant))
        .collect()
}

fn find_verdict<'s>(
    bench: &Bench,
    subject: &Subject,
    limits: &Limits,
    journal: &Journal,
    mutant: &'s MutantFilter,
) -> Verdict<'s> {
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
    for choice in &bench.scenes {
        let scene = &choice.scene.id;
        let place = subject.place(&mutant.name, scene);
        match journal.changes.get(&place) {
            None => is_tried = false,
            Some(Err(reason)) => verdict.failure = Some(reason.clone()),
            Some(Ok(change)) => {
                let larger = (verdict.change.as_ref())
                    .is_none_or(|(largest, _)| largest.floors < change.floors);
                if larger {
                    verdict.change = Some((*change, scene.clone()));
                }
            }
        }
        match journal.cases.get(&place) {
            None => verdict.is_decided &= is_same_picture(journal, &place),
            Some(Err(reason)) => verdict.failure = Some(reason.clone()),
            Some(Ok(case)) => {
                let limits = &limits[scene];
                let broken = find_broken(case, &limits.deciding);
                if !broken.is_empty() && verdict.killed.is_none() {
                    verdict.killed = Some((scene.clone(), broken));
                }
                let noticed = limits
                    .widest
                    .iter()
                    .flat_map(|widest| find_broken(case, widest));
                (verdict.noticed_by).extend(noticed.map(|metric| (metric, scene.clone())));
            }
        }
    }
    if !is_tried {
        verdict.change = None;
    }
    if let Some((_, scene)) = &verdict.change {
        verdict.error = find_error(subject, journal, mutant, scene);
    }
    verdict.is_decided |= verdict.killed.is_some() || verdict.failure.is_some();
    verdict
}

/// Divides the mean squared error of a mutant by that of the filter without a change.
fn find_error(
    subject: &Subject,
    journal: &Journal,
    mutant: &MutantFilter,
    scene: &SceneId,
) -> Option<f64> {
    let sound = journal.sound.get(&subject.sound_place(scene, SEED))?;
    let case = journal.cases.get(&subject.place(&mutant.name, scene))?;
    let error = |case: &Case| match case.scores.get("mse_moving".parse().ok()?) {
        Measured::Score(score) => Some(score.value),
        Measured::NotApplicable { .. } => None,
    };
    Some(error(case.as_ref().ok()?)? / error(sound.cases.first()?)?)
}
