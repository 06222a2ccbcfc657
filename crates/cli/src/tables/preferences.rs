//! Tables of people's preferences.

use study::{
    MIN_PEOPLE, Preferences, QuestionResult, RESAMPLES, Resampled, ScoreAgreement, ShutterScale,
};

use super::{Table, cell, legend_text, range_text};
use crate::output::{count_text, heading, push_wrapped};

/// Meaning of the columns of a scale.
const SCALE_KEY: &str = "Scale: 1 more means that three of four would choose the filter (Bradley and Terry, with Jeffreys' prior); \
                         the mean of the filters is 0. Over mean: chance to be chosen over a filter at 0. Chosen: choices, neither \
                         counts half.";
/// Meaning of the columns of scores.
const SCORES_KEY: &str = "Rank: correlation of the score's means over scenes with the scale; 1 if people rank the filters as the score \
                          does. Predicted: share of choices for the filter with the better score on that scene; coins give 50 %. Intervals \
                          do not cover the choice of filters and scenes. Scores of single pictures are those of the first frame.";

/// Makes the tables of all questions.
pub fn preferences_table(found: &Preferences) -> String {
    let questions: Vec<String> = found.questions.iter().map(question_text).collect();
    questions.join("\n")
}

fn question_text(found: &QuestionResult) -> String {
    let mut text = heading(found.question.text()) + "\n";
    let answers: usize = found.sessions.iter().map(|own| own.answers).sum();
    let mut facts = format!(
        "{}, {answers} answers",
        count_text(found.sessions.len(), "session", "sessions")
    );
    if let Some(left) = found.left {
        facts += &format!("; {:.0} % of the choices of a side were left", 100.0 * left);
    }
    push_wrapped(&mut text, 0, &facts);
    push_checks(&mut text, found);
    for scale in &found.scales {
        push_scale(&mut text, scale);
    }
    text += &legend_text(SCALE_KEY);
    if found.scales.iter().any(|scale| !scale.scores.is_empty()) {
        text += &legend_text(SCORES_KEY);
    }
    text
}

/// Names the sessions that failed checks.
fn push_checks(text: &mut String, found: &QuestionResult) {
    let checks = found.sessions.iter().map(|own| own.checks).sum();
    let failed: usize = (found.sessions.iter()).map(|own| own.failed_checks).sum();
    let all = count_text(checks, "check", "checks");
    let mut line = format!("{failed} of {all} failed");
    if failed > 0 {
        let with_failed = (found.sessions.iter()).filter(|own| own.failed_checks > 0);
        let names = with_failed.map(|own| {
            let (path, failed) = (own.path.display(), own.failed_checks);
            format!("{path} {failed} of {}", own.checks)
        });
        let names = names.collect::<Vec<_>>().join(", ");
        line += &format!(": {names}; none is left out");
    }
    push_wrapped(text, 0, &line);
}

fn push_scale(text: &mut String, scale: &ShutterScale) {
    let title = format!("{} shutter", scale.alignment);
    let mut table = Table::new(title, ["scale", "95 % CI", "over mean", "chosen", "of"]);
    for own in &scale.filters {
        let cells = [
            signed(own.scale),
            cell(own.interval, |ends| range_text(ends, signed)),
            format!("{:.0} %", 100.0 * own.chosen_over_mean),
            own.chosen.to_string(),
            own.compared.to_string(),
        ];
        table.push(&own.filter, cells);
    }
    *text += &format!("\n{}", table.text());
    for line in describe(scale) {
        push_wrapped(text, 0, &line);
    }
    if !scale.scores.is_empty() {
        *text += &format!("\n{}", score_table(&scale.scores));
    }
}

/// Describes the data of a scale.
fn describe(scale: &ShutterScale) -> Vec<String> {
    let answers = format!(
        "{} of {}, {} of them neither",
        count_text(scale.comparisons, "comparison", "comparisons"),
        count_text(scale.people, "session", "sessions"),
        scale.neither
    );
    let has_intervals = scale.filters.iter().all(|own| own.interval.is_some());
    let intervals = match scale.resampled {
        _ if !has_intervals => "too few answers for intervals".to_owned(),
        Resampled::People => format!("intervals: {RESAMPLES} resamples of sessions"),
        Resampled::Answers => format!(
            "intervals: {RESAMPLES} resamples of the answers, since there are fewer than {MIN_PEOPLE} sessions; they say how these people \
             would answer again, and nothing about others"
        ),
    };
    let mut lines = vec![format!("{answers}; {intervals}")];
    if let Some(agreement) = &scale.agreement {
        lines.push(format!(
            "people chose alike in {:.0} % of {}; coins give 50 %",
            100.0 * agreement.share,
            count_text(agreement.pairs, "pair of answers", "pairs of answers")
        ));
    }
    if !scale.separated.is_empty() {
        let groups: Vec<String> = (scale.separated.iter())
            .map(|group| group.join(", "))
            .collect();
        lines.push(format!(
            "no filter of one of these groups was ever chosen against one of a group above it: the prior alone holds their distance, and more \
             answers may widen it: {}",
            groups.join(" | ")
        ));
    }
    lines
}

fn score_table(scores: &[ScoreAgreement]) -> String {
    let columns = ["rank", "95 % CI", "predicted", "95 % CI", "choices"];
    let mut table = Table::new("score", columns);
    for own in scores {
        let percent = |share: f64| format!("{:.0}", 100.0 * share);
        let cells = [
            cell(own.correlation, signed),
            cell(own.correlation_interval, |ends| range_text(ends, signed)),
            cell(own.predicted, |share| percent(share) + " %"),
            cell(own.predicted_interval, |ends| {
                range_text(ends, percent) + " %"
            }),
            own.choices.to_string(),
        ];
        table.push(own.score.name(), cells);
    }
    table.text()
}

/// Formats a number with its sign, but never "-0.00".
fn signed(value: f64) -> String {
    let rounded = (value * 100.0).round() / 100.0 + 0.0;
    format!("{rounded:+.2}")
}
