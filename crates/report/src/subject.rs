//! Rows of the overview: filter presets and bars.

use metrics::Measured;

use suite::Headline;
use suite::{Case, Overall, Run};

/// One filter preset with one form of its input, or one bar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Subject {
    /// `jump_flood:paper`.
    pub name: String,
    /// Whether it is a bar, and no filter.
    pub bar: bool,
    /// The shutter alignment that it is scored against.
    pub alignment: String,
}

impl Subject {
    /// What a case is of.
    pub fn of(case: &Case) -> Self {
        Self {
            name: case.name(),
            bar: case.is_reference,
            alignment: case.alignment.clone(),
        }
    }

    /// How a reader tells it from others: bars are made anew for every alignment.
    pub fn title(&self) -> String {
        match self.bar {
            true => format!("{} ({})", self.name, self.alignment),
            false => self.name.clone(),
        }
    }

    /// Its mean over scenes.
    pub fn is_of(&self, overall: &Overall) -> bool {
        (self.bar, &self.name, &self.alignment)
            == (overall.is_reference, &overall.filter, &overall.alignment)
    }
}

/// Every subject of a run, in the order they ran.
pub fn subjects(run: &Run) -> Vec<Subject> {
    once(run.cases.iter().map(Subject::of))
}

/// Every scene of a run, in the order they ran.
pub fn scenes(run: &Run) -> Vec<&str> {
    once(run.cases.iter().map(|case| case.scene.as_str()))
}

/// Every shutter alignment of some subjects.
pub fn alignments(subjects: &[Subject]) -> Vec<&str> {
    once(subjects.iter().map(|subject| subject.alignment.as_str()))
}

/// The number of a subject's case of one scene.
pub fn case_of(run: &Run, subject: &Subject, scene: &str) -> Option<usize> {
    (run.cases.iter()).position(|case| case.scene == scene && Subject::of(case) == *subject)
}

/// The mean over a subject's scenes of a score's noise floor; none where the score applies to none.
pub fn mean_floor(run: &Run, subject: &Subject, headline: Headline) -> Option<f64> {
    let own = run
        .cases
        .iter()
        .filter(|case| Subject::of(case) == *subject);
    let floors: Vec<f64> = own
        .filter_map(|case| match headline.measured(case) {
            Measured::Score(score) => Some(score.floor),
            Measured::NotApplicable { .. } => None,
        })
        .collect();
    (!floors.is_empty()).then(|| floors.iter().sum::<f64>() / floors.len() as f64)
}

fn once<T: PartialEq>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut once = Vec::new();
    for one in all {
        if !once.contains(&one) {
            once.push(one);
        }
    }
    once
}
