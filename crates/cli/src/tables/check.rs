//! Text of a check: every score that does not keep its bound.

use std::fmt::Write;
use std::path::Path;

use judge::{BaselineComparison, Check, Decision, Finding, Level, Outcome, number};
use report::{finding_score, finding_status, length_text, way_out, worst_frame_text};
use store::printable_path;

use super::failures_text;
use crate::output::{bad, count_text, doubtful, good, heading, push_wrapped};

/// Lists scores that are broken, undecided or limited within the noise, by scene and filter; then comparisons, then counts. Targets, which
/// fail nothing, are listed where `targets` asks for them. `out` is the folder of the run's pictures.
pub fn check_text(check: &Check, out: &Path, targets: bool) -> String {
    let mut text = failures_text(&check.failures);
    let mut case = None;
    for finding in &check.findings {
        let is_listed = targets || finding.decision() != Decision::Pass;
        if !finding.outcome.is_notable() || !is_listed {
            continue;
        }
        let own = format!("{} / {}", finding.scene, finding.filter);
        if case.as_ref() != Some(&own) {
            let _ = writeln!(text, "{}", heading(&own));
            case = Some(own);
        }
        for (indent, line) in finding_lines(finding, out) {
            push_wrapped(&mut text, indent, &line);
        }
    }
    if !check.comparisons.is_empty() {
        text += &(heading("compared with the baseline") + "\n");
        for comparison in &check.comparisons {
            push_wrapped(&mut text, 2, &comparison_line(comparison));
        }
    }
    for line in count_lines(check) {
        push_wrapped(&mut text, 0, &line);
    }
    text
}

/// Names a decision as a verdict.
pub fn verdict_word(decision: Decision) -> &'static str {
    match decision {
        Decision::Pass => "PASS",
        Decision::Broken => "FAIL",
        Decision::Inconclusive | Decision::Misconfigured => "UNDECIDED",
    }
}

/// Ends a check with its verdict, and the way out of one that is undecided.
pub fn verdict_text(check: &Check) -> String {
    let word = verdict_word(check.decision);
    let verdict = match check.decision {
        Decision::Pass => good(word),
        Decision::Broken => bad(word),
        Decision::Inconclusive | Decision::Misconfigured => doubtful(word),
    };
    match check.verdict() {
        Ok(()) => format!("{verdict}\n"),
        Err(error) => {
            let mut text = String::new();
            push_wrapped(&mut text, 0, &format!("{verdict}: {error}"));
            text
        }
    }
}

fn finding_lines(finding: &Finding, out: &Path) -> Vec<(usize, String)> {
    let status = match finding.outcome {
        Outcome::Broken => bad(finding_status(finding)),
        Outcome::Kept => good(finding_status(finding)),
        _ => doubtful(finding_status(finding)),
    };
    let mut lines = vec![
        (2, format!("{status} {}", finding_score(finding))),
        (6, place_text(finding)),
    ];
    if let Some(worst) = &finding.worst {
        let picture = out.join(&worst.picture);
        lines.push((
            6,
            format!(
                "worst at ({}, {}): {}",
                worst.x,
                worst.y,
                printable_path(&picture)
            ),
        ));
    }
    if let Some(frame) = worst_frame_text(finding) {
        let pictures = out.join(&finding.pictures);
        lines.push((6, format!("{frame}: {}", printable_path(&pictures))));
    }
    if let Some(alike) = &finding.resembles {
        let distance = (100.0 * alike.distance).round();
        lines.push((6, format!("most like {}, {distance} % off", alike.decoy)));
    } else if finding.worst.is_some() {
        lines.push((6, "no known failure pattern matched".to_owned()));
    }
    if let Some(way_out) = way_out(finding) {
        lines.push((6, way_out));
    }
    if finding.worst.is_some() {
        lines.push((
            6,
            format!("pictures: {}", printable_path(&out.join(&finding.pictures))),
        ));
    }
    lines
}

fn place_text(finding: &Finding) -> String {
    format!("{}: {}", finding.place, finding.why)
}

/// Describes a comparison with the baseline on one line.
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
        "{}: {filter} {metric}, worse by {} over {scenes}, one-sided 95 % bounds {} and {}; margin {}",
        comparison.kind.label(),
        number(*worse),
        number(*low),
        number(*high),
        number(*margin)
    )
}

/// Counts required bounds, and apart from them targets.
pub fn count_lines(check: &Check) -> Vec<String> {
    let of_level = |level: Level| {
        check
            .findings
            .iter()
            .filter(move |finding| finding.level == level)
    };
    let count = |level: Level, outcome: Outcome| {
        of_level(level)
            .filter(|finding| finding.outcome == outcome)
            .count()
    };
    let counts = |level: Level, kept: &str, broken: &str| {
        let words = [
            (Outcome::Kept, kept),
            (Outcome::Broken, broken),
            (Outcome::Inconclusive, "undecided"),
            (Outcome::TooNoisy, "with a limit within the noise"),
            (Outcome::NotApplicable, "not applicable"),
            (Outcome::NotJudged, "not judged"),
        ];
        let words = words.map(|(outcome, word)| (count(level, outcome), word));
        let words = words.iter().filter(|(count, _)| *count > 0);
        let words: Vec<String> = words
            .map(|(count, word)| format!("{count} {word}"))
            .collect();
        words.join(", ")
    };
    let mut lines = Vec::new();
    if of_level(Level::Required).next().is_some() {
        lines.push(format!(
            "{}: {}",
            count_text(
                of_level(Level::Required).count(),
                "required bound",
                "required bounds"
            ),
            counts(Level::Required, "met", "broken")
        ));
    }
    if of_level(Level::Report).next().is_some() {
        lines.push(format!(
            "{}: {} (a missed target fails nothing; -v lists them)",
            count_text(of_level(Level::Report).count(), "target", "targets"),
            counts(Level::Report, "met", "missed")
        ));
    }
    lines.extend(not_judged_line(check));
    lines
}

/// Says which limits were not judged, since they are on sequences of another length, and how they are; none where all were.
fn not_judged_line(check: &Check) -> Option<String> {
    let findings = check.findings.iter();
    let not_judged = findings.filter(|finding| finding.outcome == Outcome::NotJudged);
    let mut lengths: Vec<(String, String)> = Vec::new();
    for finding in not_judged {
        let length = length_text(finding)?;
        let fps = finding.fps.map(|fps| format!(" --fps {fps}"));
        let options = format!("--frames {}{}", finding.frames?, fps.unwrap_or_default());
        if !lengths.iter().any(|(known, _)| *known == length) {
            lengths.push((length, options));
        }
    }
    let list = |part: fn(&(String, String)) -> &String| {
        let parts: Vec<&str> = lengths.iter().map(|own| part(own).as_str()).collect();
        parts.join(", ")
    };
    (!lengths.is_empty()).then(|| {
        format!(
            "not judged: limits on sequences of {}; measure with {} to judge them",
            list(|own| &own.0),
            list(|own| &own.1)
        )
    })
}
