//! Text of a check: every score outside its bound.

use std::path::Path;

use judge::{
    Decision, Finding, Level, MAX_SAMPLES, Outcome, Verdict, Worst, few_scenes_text, number,
};
use report::{finding_score, finding_status, length_text, way_out, worst_frame_text};

use super::list_once;
use crate::baseline::{BaselineComparison, ComparisonKind, DecidedBy};
use crate::check::Check;
use run::failures_text;
use terminal::output::{Text, bad, count_text, doubtful, good, heading, push_wrapped};

/// Lists scores that are broken, undecided or limited within the noise, by scene and filter; then
/// comparisons, then counts. Lists targets, which fail nothing, only if `targets` is set. `out` is
/// the folder of the run's pictures.
pub fn check_text(check: &Check, out: &Path, targets: bool) -> Text {
    let mut text = failures_text(&check.failures);
    let mut case = None;
    for finding in &check.findings {
        let is_listed = targets || finding.decision() != Decision::Pass;
        if !finding.outcome.is_notable() || !is_listed {
            continue;
        }
        let name = format!("{} / {}", finding.scene, finding.filter);
        if case.as_ref() != Some(&name) {
            text += heading(&name) + "\n";
            case = Some(name);
        }
        push_finding(&mut text, finding, out);
    }
    if !check.comparisons.is_empty() {
        text += heading("compared with the baseline") + "\n";
        for comparison in &check.comparisons {
            push_wrapped(&mut text, 2, comparison_line(comparison));
        }
        let scenes = check.comparisons.iter().map(|compared| compared.scenes);
        if let Some(few) = scenes.max().and_then(few_scenes_text) {
            push_wrapped(&mut text, 2, few);
        }
    }
    for line in count_lines(check) {
        push_wrapped(&mut text, 0, line);
    }
    text
}

/// Formats a check's verdict, and what helps if it is undecided.
pub fn verdict_text(check: &Check) -> Text {
    let word = check.decision.word();
    let verdict = match check.decision {
        Decision::Pass => good(word),
        Decision::Broken => bad(word),
        Decision::Inconclusive | Decision::Misconfigured => doubtful(word),
    };
    match check.verdict() {
        Ok(()) => verdict + "\n",
        Err(error) => {
            let mut text = Text::default();
            push_wrapped(&mut text, 0, verdict + format!(": {error}"));
            text
        }
    }
}

/// Returns a check's verdict for its page.
pub fn page_verdict(check: &Check) -> Verdict {
    let open =
        (check.comparisons.iter()).filter(|comparison| comparison.decision() != Decision::Pass);
    Verdict {
        decision: check.decision,
        reason: check.verdict().err().map(|error| error.to_string()),
        comparisons: open.map(comparison_line).collect(),
    }
}

fn push_finding(text: &mut Text, finding: &Finding, out: &Path) {
    let status = finding_status(finding);
    let status = match finding.outcome {
        Outcome::Broken => bad(status),
        Outcome::Kept => good(status),
        _ => doubtful(status),
    };
    push_wrapped(text, 2, status + format!(" {}", finding_score(finding)));
    let mut push = |line: String| push_wrapped(text, 6, line);
    push(format!("{}: {}", finding.place, finding.why));
    let pictures = out.join(&finding.pictures).display().to_string();
    if let Some(Worst { x, y, picture, .. }) = &finding.worst {
        push(format!(
            "worst at ({x}, {y}): {}",
            out.join(picture).display()
        ));
    }
    if let Some(frame) = worst_frame_text(finding) {
        push(format!("{frame}: {pictures}"));
    }
    if let Some(alike) = &finding.resembles {
        let distance = (100.0 * alike.distance).round();
        push(format!("most like {}, {distance} % off", alike.decoy));
    } else if finding.worst.is_some() {
        push("no known failure pattern matched".to_owned());
    }
    if let Some(way_out) = way_out(finding) {
        push(way_out);
    }
    if finding.worst.is_some() {
        push(format!("pictures: {pictures}"));
    }
}

/// Describes a comparison with the baseline on one line, with the uncertainty that decided it.
pub fn comparison_line(comparison: &BaselineComparison) -> String {
    let BaselineComparison {
        filter,
        metric,
        scenes,
        worse,
        interval: [low, high],
        margin,
        ..
    } = comparison;
    let scenes = count_text(*scenes, "scene", "scenes");
    format!(
        "{}: {filter} {metric}, worse by {} over {scenes}, one-sided 95 % bounds {} and {}; margin {}; {}",
        comparison.kind.label(),
        number(*worse),
        number(*low),
        number(*high),
        number(*margin),
        decision_text(comparison)
    )
}

/// Says which uncertainty decided a comparison, on which scenes, and what would decide an open one.
fn decision_text(comparison: &BaselineComparison) -> String {
    let losses = comparison.losses.iter().map(|loss| {
        let [worse, noise] = [loss.worse, loss.noise].map(number);
        format!(
            "{} by {worse} (the truth's noise is {noise} at most)",
            loss.scene
        )
    });
    let losses = losses.collect::<Vec<_>>().join(", ");
    match (comparison.kind, comparison.decided_by) {
        (_, DecidedBy::Scenes) => "the scatter over the scenes decides".to_owned(),
        (ComparisonKind::NoWorse, DecidedBy::Noise) => {
            "on no scene worse by more, with the truth's noise".to_owned()
        }
        (ComparisonKind::Worse, DecidedBy::Noise) => format!("certainly worse on {losses}"),
        (ComparisonKind::Inconclusive, DecidedBy::Noise) => {
            let way_out = match comparison.settled_by {
                None | Some(MAX_SAMPLES..) => {
                    "too close to the margin for any number of samples; move the margin".to_owned()
                }
                Some(samples) => format!("{samples} samples per pixel would settle it"),
            };
            format!("the truth's noise leaves open {losses}; {way_out}")
        }
    }
}

/// Counts required bounds, targets and comparisons with a baseline separately.
pub fn count_lines(check: &Check) -> Vec<String> {
    let line = |level: Level, one: &str, [kept, broken]: [&str; 2], note: &str| {
        let findings = check.findings.iter();
        let findings: Vec<&Finding> = findings.filter(|finding| finding.level == level).collect();
        let words = [
            (Outcome::Kept, kept),
            (Outcome::Broken, broken),
            (Outcome::Inconclusive, "undecided"),
            (Outcome::TooNoisy, "with a limit within the noise"),
            (Outcome::NotApplicable, "not applicable"),
            (Outcome::NotJudged, "not judged"),
        ];
        let counts = words.iter().filter_map(|(outcome, word)| {
            let count = findings
                .iter()
                .filter(|finding| finding.outcome == *outcome)
                .count();
            (count > 0).then(|| format!("{count} {word}"))
        });
        let counts = counts.collect::<Vec<_>>().join(", ");
        let all = count_text(findings.len(), one, &format!("{one}s"));
        (!findings.is_empty()).then(|| format!("{all}: {counts}{note}"))
    };
    let note = " (a missed target fails nothing; -v lists them)";
    let required = line(Level::Required, "required bound", ["met", "broken"], "");
    let targets = line(Level::Report, "target", ["met", "missed"], note);
    let lines = [
        required,
        targets,
        comparisons_line(check),
        not_judged_line(check),
    ];
    lines.into_iter().flatten().collect()
}

/// Counts comparisons with a baseline by their verdict; none without a baseline.
fn comparisons_line(check: &Check) -> Option<String> {
    let count = |kind| {
        let comparisons = check
            .comparisons
            .iter()
            .filter(|comparison| comparison.kind == kind);
        comparisons.count()
    };
    let words = [
        (ComparisonKind::NoWorse, "no worse"),
        (ComparisonKind::Worse, "worse"),
        (ComparisonKind::Inconclusive, "undecided"),
    ];
    let counts = (words.iter()).filter_map(|(kind, word)| match count(*kind) {
        0 => None,
        count => Some(format!("{count} {word}")),
    });
    let counts = counts.collect::<Vec<_>>().join(", ");
    let compared = check.comparisons.len();
    let all = count_text(
        compared,
        "comparison with the baseline",
        "comparisons with the baseline",
    );
    (compared > 0).then(|| format!("{all}: {counts}"))
}

/// Names the limits that were not judged because they are for sequences of another length, and how
/// to judge them; none if all were judged.
fn not_judged_line(check: &Check) -> Option<String> {
    let mut lengths: Vec<(String, String)> = Vec::new();
    for finding in (check.findings.iter()).filter(|finding| finding.outcome == Outcome::NotJudged) {
        let fps = finding.fps.map(|fps| format!(" --fps {fps}"));
        let options = format!("--frames {}{}", finding.frames?, fps.unwrap_or_default());
        lengths.push((length_text(finding)?, options));
    }
    let (lengths, options): (Vec<_>, Vec<_>) = list_once(lengths.into_iter()).into_iter().unzip();
    (!lengths.is_empty()).then(|| {
        format!(
            "not judged: limits on sequences of {}; measure with {} to judge them",
            lengths.join(", "),
            options.join(", ")
        )
    })
}
