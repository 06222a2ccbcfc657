//! Sessions: files of answers, read and compared with the design that their seeds draw.

use std::path::{Path, PathBuf};

use serde_json::json;
use store::read_text_within;
use suite::Error;

use crate::answers::{
    ANSWERS_FORMAT, AnswerFile, Chosen, MAX_ANSWER_BYTES, SHARP_CLIP, TRUTH_CLIP,
};
use crate::design::{Clip, ShownPair, draw_session};
use crate::paired_counts::Comparison;
use crate::question::Question;
use crate::study::Study;

/// Upper limit on sessions that are read together.
pub const MAX_SESSIONS: usize = 1000;
/// Largest seed: JavaScript's numbers hold it exactly.
const LARGEST_SEED: u64 = (1 << 53) - 1;

/// Answers of one person to one question, in their order.
#[derive(Clone, Debug)]
pub struct Session {
    /// File that it was read from.
    pub path: PathBuf,
    /// The question.
    pub question: Question,
    /// Seed of the session.
    pub seed: u64,
    /// Trials, and what was chosen.
    pub answers: Vec<(ShownPair, Chosen)>,
}

/// Reads sessions of one study; returns them with it.
///
/// # Errors
/// A file holds no answers, has another format or another study, shows pairs that its seed does not draw, or repeats another one's
/// seed.
pub fn read_sessions(paths: &[PathBuf]) -> Result<(Study, Vec<Session>), Error> {
    if !(1..=MAX_SESSIONS).contains(&paths.len()) {
        return Err(Error::Usage(format!(
            "{} files of answers; allowed: 1 to {MAX_SESSIONS}",
            paths.len()
        )));
    }
    let mut first: Option<Study> = None;
    let mut sessions: Vec<Session> = Vec::new();
    for path in paths {
        let refuse = |reason: String| Error::Usage(format!("{}: {reason}", path.display()));
        let file = parse(&read_text_within(path.as_path(), MAX_ANSWER_BYTES)?).map_err(refuse)?;
        let study = first.get_or_insert_with(|| file.study.clone());
        if *study != file.study {
            return Err(refuse(format!(
                "answers about other pictures than {}: {}; give files of one page",
                paths[0].display(),
                describe_difference(study, &file.study)
            )));
        }
        if let Some(other) = sessions.iter().find(|other| other.seed == file.seed) {
            return Err(refuse(format!(
                "has the seed {} of {}: one session counts once; give one of both files",
                file.seed,
                other.path.display()
            )));
        }
        let answers = match_design(&file).map_err(refuse)?;
        sessions.push(Session {
            path: path.clone(),
            question: file.question,
            seed: file.seed,
            answers,
        });
    }
    Ok((first.expect("there is a file"), sessions))
}

impl Session {
    /// Lists the comparisons between filters of one shutter.
    pub fn comparisons(&self, shutter: usize) -> Vec<Comparison> {
        let own = (self.answers.iter()).filter(|(trial, _)| trial.shutter == shutter);
        own.filter_map(|(trial, choice)| trial.comparison(*choice))
            .collect()
    }

    /// Counts the checks that were answered, and the wrong answers among them.
    pub fn checks(&self) -> [usize; 2] {
        let answers = self.answers.iter();
        let right: Vec<bool> = answers
            .filter_map(|(trial, choice)| is_right(trial, *choice))
            .collect();
        let wrong = right.iter().filter(|is_right| !**is_right).count();
        [right.len(), wrong]
    }
}

/// Returns whether a check was answered correctly; none for other pairs.
fn is_right(trial: &ShownPair, choice: Chosen) -> Option<bool> {
    let right = match (trial.left, trial.right) {
        (Clip::Truth, _) => Chosen::Left,
        (_, Clip::Truth) => Chosen::Right,
        _ => Chosen::Neither,
    };
    trial.is_check().then_some(choice == right)
}

/// Parses a file of answers; the error says what is wrong.
fn parse(text: &str) -> Result<AnswerFile, String> {
    let broken = |error: serde_json::Error| {
        format!("is no file of answers: {error}; the page of `ask` writes one")
    };
    let plain: serde_json::Value = serde_json::from_str(text).map_err(broken)?;
    let format = plain.get("format").and_then(serde_json::Value::as_u64);
    let format =
        format.ok_or("is no file of answers: it has no format; the page of `ask` writes one")?;
    if format != u64::from(ANSWERS_FORMAT) {
        return Err(format!(
            "has format {format}; allowed: {ANSWERS_FORMAT}; another version of the program made the page"
        ));
    }
    let file: AnswerFile = serde_json::from_value(plain).map_err(broken)?;
    (file.study.check()).map_err(|reason| format!("its page {reason}"))?;
    match file.seed <= LARGEST_SEED {
        true => Ok(file),
        false => Err(format!(
            "has the seed {}; allowed: 0 to {LARGEST_SEED}",
            file.seed
        )),
    }
}

/// Matches answers with the design that their seed draws.
fn match_design(file: &AnswerFile) -> Result<Vec<(ShownPair, Chosen)>, String> {
    let trials = draw_session(&file.study, file.question, file.seed);
    if file.answers.is_empty() || file.answers.len() > trials.len() {
        return Err(format!(
            "holds {} answers; allowed: 1 to {}, the questions of its page",
            file.answers.len(),
            trials.len()
        ));
    }
    for (index, (answer, trial)) in file.answers.iter().zip(&trials).enumerate() {
        let place = || format!("answer {} of {}", index + 1, file.answers.len());
        let expected = shown(&file.study, trial);
        let found = [
            &answer.scene.to_string(),
            answer.alignment.name(),
            &answer.left,
            &answer.right,
        ];
        if found != expected.each_ref().map(String::as_str) {
            return Err(format!(
                "{} is about {}; the seed {} shows {} there; give the file as the page wrote it",
                place(),
                found.join(" / "),
                file.seed,
                expected.join(" / ")
            ));
        }
        let (milliseconds, zoom) = (answer.milliseconds, answer.zoom);
        if !milliseconds.is_finite() || milliseconds < 0.0 || zoom < 1 {
            return Err(format!(
                "{} took {milliseconds} milliseconds at zoom {zoom}; allowed: 0 or more, and 1 or more",
                place()
            ));
        }
    }
    let choices = file.answers.iter().map(|answer| answer.choice);
    Ok(trials.into_iter().zip(choices).collect())
}

/// Names what a trial shows: scene, alignment, left and right.
fn shown(study: &Study, trial: &ShownPair) -> [String; 4] {
    let shutter = &study.shutters[trial.shutter];
    let name = |clip: Clip| match clip {
        Clip::Filter(filter) => shutter.filters[filter].clone(),
        Clip::Truth => TRUTH_CLIP.to_owned(),
        Clip::Sharp => SHARP_CLIP.to_owned(),
    };
    let scene = study.scenes[trial.scene].to_string();
    let alignment = shutter.alignment.to_string();
    [scene, alignment, name(trial.left), name(trial.right)]
}

/// Names the difference between two studies.
fn describe_difference(one: &Study, other: &Study) -> String {
    let [one, other] = [one, other].map(|own| {
        let shutters = || own.shutters.iter();
        let filters: Vec<_> = shutters().map(|own| &own.filters).collect();
        let truths: Vec<_> = shutters().map(|own| &own.truth_hashes).collect();
        [
            ("scenes", json!(own.scenes)),
            ("filters", json!(filters)),
            ("size", json!([own.width, own.height])),
            ("frames", json!(own.frames)),
            ("truths", json!(truths)),
            ("pictures", json!(own.pictures)),
            ("number of pairs", json!(own.most_pairs)),
        ]
    });
    let mut pairs = one.iter().zip(&other);
    let found = pairs.find(|(one, other)| one != other);
    let what = found.map_or("shutters", |((what, _), _)| what);
    format!("the {what} differ")
}

/// Refuses a run other than the study's: its truths or its pictures differ.
pub fn refuse_other_run(study: &Study, of_run: &Study, run: &Path) -> Result<(), Error> {
    // The number of pairs in a session does not depend on the run.
    let same = Study {
        most_pairs: study.most_pairs,
        ..of_run.clone()
    };
    match same == *study {
        true => Ok(()),
        false => Err(Error::Usage(format!(
            "{}: the answers are about another run: {}; give the run that the page was made of",
            run.display(),
            describe_difference(study, &same)
        ))),
    }
}
