//! What people prefer: a scale per question and shutter.

use std::path::PathBuf;

use frame::Alignment;
use serde::Serialize;
use suite::{Error, PROGRAM, Run};

use crate::agreement::{PeopleAgreement, measure_agreement};
use crate::answers::Chosen;
use crate::bradley_terry::chance;
use crate::paired_counts::PairedCounts;
use crate::preference_scale::{PreferenceScale, RESAMPLES, Resampled, scale_preferences};
use crate::question::Question;
use crate::score_agreement::{ScoreAgreement, compare_scores};
use crate::session::Session;
use crate::study::{Study, StudyShutter};

/// Version of the layout of the preferences that are printed as JSON.
pub const PREFERENCES_FORMAT: u32 = 1;

/// Preferences of people.
#[derive(Clone, Debug, Serialize)]
pub struct Preferences {
    /// [`PREFERENCES_FORMAT`].
    pub format: u32,
    /// Program and version.
    pub program: String,
    /// Results of each question that was answered.
    pub questions: Vec<QuestionResult>,
}

/// Answers to one question.
#[derive(Clone, Debug, Serialize)]
pub struct QuestionResult {
    /// The question.
    pub question: Question,
    /// Sessions, one per file.
    pub sessions: Vec<SessionFacts>,
    /// Share of the left clip among choices of a side, checks left out; near 1/2 unless people prefer a side.
    pub left: Option<f64>,
    /// Scales, one per shutter.
    pub scales: Vec<ShutterScale>,
}

/// Facts about a session.
#[derive(Clone, Debug, Serialize)]
pub struct SessionFacts {
    /// File that it was read from.
    pub path: PathBuf,
    /// Number of answers, checks among them.
    pub answers: usize,
    /// Number of checks that were answered.
    pub checks: usize,
    /// Number of those that were answered wrongly.
    pub failed_checks: usize,
}

/// Scale of the filters of one shutter, over all scenes.
#[derive(Clone, Debug, Serialize)]
pub struct ShutterScale {
    /// Alignment of the shutter.
    pub alignment: Alignment,
    /// Number of sessions that compare any of its filters.
    pub people: usize,
    /// Number of comparisons.
    pub comparisons: usize,
    /// Number of comparisons in which neither was chosen.
    pub neither: usize,
    /// What the intervals were resampled over.
    pub resampled: Resampled,
    /// Filters, the most preferred first.
    pub filters: Vec<FilterStrength>,
    /// Groups of filters between which all choices went one way, if there is more than one group: only the prior limits the distance
    /// between them.
    pub separated: Vec<Vec<String>>,
    /// Agreement between people; none if no two compared the same clips.
    pub agreement: Option<PeopleAgreement>,
    /// Scores of the run compared with the scale; empty without a run.
    pub scores: Vec<ScoreAgreement>,
}

/// Place of a filter on the scale.
#[derive(Clone, Debug, Serialize)]
pub struct FilterStrength {
    /// Name of the filter.
    pub filter: String,
    /// Place; the mean of all filters is 0. A filter that is 1 higher is chosen by 75 of 100 people.
    pub scale: f64,
    /// 95 % confidence interval; none if there are too few answers.
    pub interval: Option<[f64; 2]>,
    /// Probability that it is chosen over a filter at 0.
    pub chosen_over_mean: f64,
    /// How often it was chosen; choices of neither count half.
    pub chosen: f64,
    /// How often it was compared.
    pub compared: f64,
}

/// Computes the preferences of sessions about a study. With a run, scores are compared with them.
///
/// # Errors
/// The comparisons of a question do not connect all filters of a shutter: there is no scale.
pub fn find_preferences(
    study: &Study,
    sessions: &[Session],
    run: Option<&Run>,
) -> Result<Preferences, Error> {
    let mut questions = Vec::new();
    for question in Question::ALL {
        let own: Vec<&Session> = (sessions.iter())
            .filter(|session| session.question == *question)
            .collect();
        if own.is_empty() {
            continue;
        }
        let scales = (0..study.shutters.len()).map(|shutter| {
            scale_shutter(study, shutter, &own, run)
                .map_err(|reason| Error::Usage(format!("\"{}\": {reason}", question.text())))
        });
        questions.push(QuestionResult {
            question: *question,
            sessions: own.iter().map(|session| session_facts(session)).collect(),
            left: left_share(&own),
            scales: scales.collect::<Result<_, _>>()?,
        });
    }
    Ok(Preferences {
        format: PREFERENCES_FORMAT,
        program: PROGRAM.to_owned(),
        questions,
    })
}

fn scale_shutter(
    study: &Study,
    shutter: usize,
    sessions: &[&Session],
    run: Option<&Run>,
) -> Result<ShutterScale, String> {
    let own = &study.shutters[shutter];
    let people: Vec<Vec<_>> = (sessions.iter())
        .map(|session| session.comparisons(shutter))
        .filter(|own| !own.is_empty())
        .collect();
    let all = people.concat();
    let counts = PairedCounts::new(own.filters.len(), &all);
    let scale = scale_preferences(&people, own.filters.len(), RESAMPLES).ok_or_else(|| {
        let groups = names(own, &counts.connected());
        let groups: Vec<String> = groups.iter().map(|group| group.join(", ")).collect();
        format!(
            "no scale of the {} shutter exists: no answers connect {}; collect more answers, or whole sessions",
            own.alignment,
            groups.join(" | ")
        )
    })?;
    let mut separated = names(own, &counts.tied());
    if separated.len() == 1 {
        separated.clear();
    }
    let scores = run.map(|run| compare_scores(run, study, shutter, &people, &scale));
    Ok(ShutterScale {
        alignment: own.alignment,
        people: people.len(),
        comparisons: all.len(),
        neither: all.iter().filter(|own| own.share == 0.5).count(),
        resampled: scale.resampled,
        filters: list_filters(own, &scale, &counts),
        separated,
        agreement: measure_agreement(&people),
        scores: scores.unwrap_or_default(),
    })
}

/// Lists the filters, the most preferred first.
fn list_filters(
    own: &StudyShutter,
    scale: &PreferenceScale,
    counts: &PairedCounts,
) -> Vec<FilterStrength> {
    // Odds of 3 to 1 are a step of 1, as in JOD.
    let step = 3.0_f64.ln();
    let strength = |filter: usize| {
        let [chosen, compared] = counts.totals(filter);
        let intervals = scale.intervals.as_ref();
        FilterStrength {
            filter: own.filters[filter].clone(),
            scale: scale.strengths[filter] / step,
            interval: intervals.map(|all| all[filter].map(|end| end / step)),
            chosen_over_mean: chance(scale.strengths[filter]),
            chosen,
            compared,
        }
    };
    let mut filters: Vec<FilterStrength> = (0..own.filters.len()).map(strength).collect();
    filters.sort_by(|a, b| b.scale.total_cmp(&a.scale));
    filters
}

fn names(own: &StudyShutter, groups: &[Vec<usize>]) -> Vec<Vec<String>> {
    let name = |filter: &usize| own.filters[*filter].clone();
    let names = |group: &Vec<usize>| group.iter().map(name).collect();
    groups.iter().map(names).collect()
}

fn session_facts(session: &Session) -> SessionFacts {
    let [checks, failed_checks] = session.checks();
    SessionFacts {
        path: session.path.clone(),
        answers: session.answers.len(),
        checks,
        failed_checks,
    }
}

fn left_share(sessions: &[&Session]) -> Option<f64> {
    let answers = sessions.iter().flat_map(|session| &session.answers);
    let sides: Vec<f64> = answers
        .filter(|(trial, choice)| !trial.is_check() && *choice != Chosen::Neither)
        .map(|(_, choice)| if *choice == Chosen::Left { 1.0 } else { 0.0 })
        .collect();
    (!sides.is_empty()).then(|| sides.iter().sum::<f64>() / sides.len() as f64)
}
