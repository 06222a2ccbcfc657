//! A check as text: every score that does not keep its bound.

use std::fmt::Write;

use super::finding::{MOST_SAMPLES, number};
use super::{Check, Finding, Kind};
use crate::baseline::Comparison;
use crate::bounds::Level;
use crate::failure::failures_text;
use crate::paint::{bad, doubtful, good, heading};
use crate::printable::printable_path;
use crate::wrapped::push_wrapped;

/// What is broken, inconclusive or too narrow, by scene and filter, then the comparisons, then the counts. `out` is the
/// folder of the run's pictures.
pub fn check_text(check: &Check, out: &std::path::Path) -> String {
    let mut text = failures_text(&check.failures);
    let mut case = (String::new(), String::new());
    for finding in &check.findings {
        if matches!(finding.kind, Kind::Kept | Kind::NotApplicable) {
            continue;
        }
        let own = (finding.scene.clone(), finding.filter.clone());
        if case != own {
            let _ = writeln!(text, "{}", heading(&format!("{} / {}", own.0, own.1)));
            case = own;
        }
        for (indent, line) in lines(finding, out) {
            push_wrapped(&mut text, indent, &line);
        }
    }
    if !check.comparisons.is_empty() {
        text += &(heading("compared with the baseline") + "\n");
        for comparison in &check.comparisons {
            push_wrapped(&mut text, 2, &comparison_line(comparison));
        }
    }
    text + &counts(check)
}

fn lines(finding: &Finding, out: &std::path::Path) -> Vec<(usize, String)> {
    let status = match finding.kind {
        Kind::Broken => bad(status(finding)),
        Kind::Kept => good(status(finding)),
        _ => doubtful(status(finding)),
    };
    let mut lines = vec![
        (2, format!("{status} {}", score(finding))),
        (6, place(finding)),
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
    if let Some(alike) = &finding.resembles {
        let distance = (100.0 * alike.distance).round();
        lines.push((6, format!("most like {}, {distance} % off", alike.decoy)));
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

/// `BROKEN flip_moving 0.0921 (95 % CI 0.0893 to 0.0950); limit 0.0500, floor 0.0021`
pub(crate) fn headline(finding: &Finding) -> String {
    format!("{} {}", status(finding), score(finding))
}

fn status(finding: &Finding) -> &'static str {
    match (finding.kind, finding.level) {
        (Kind::Broken, Level::Required) => "BROKEN",
        (Kind::Broken, Level::Report) => "broken (report)",
        (Kind::Inconclusive, Level::Required) => "INCONCLUSIVE",
        (Kind::Inconclusive, Level::Report) => "inconclusive (report)",
        (Kind::TooNoisy, _) => "TOO STRICT",
        (Kind::Kept, _) => "kept",
        (Kind::NotApplicable, _) => "not applicable",
    }
}

fn score(finding: &Finding) -> String {
    let mut text = finding.metric.clone();
    if let Some(value) = finding.value {
        text += &format!(" {}", finding.shown(value));
    }
    if let Some(interval) = &finding.interval {
        let [low, high] = [interval.low, interval.high].map(number);
        text += &format!(" (95 % CI {low} to {high})");
    }
    text += &format!("; limit {}", number(finding.limit));
    if let Some(floor) = finding.floor {
        text += &format!(", floor {}", number(floor));
    }
    text
}

fn place(finding: &Finding) -> String {
    format!("{}: {}", finding.place, finding.why)
}

/// What to do about a score that was not judged.
pub(crate) fn way_out(finding: &Finding) -> Option<String> {
    match finding.kind {
        Kind::TooNoisy => Some(format!(
            "the noise floor of {} allows {} at the strictest; raise the limit, or --samples-per-pixel",
            number(finding.floor?),
            number(finding.strictest?)
        )),
        Kind::Inconclusive => Some(match finding.settled_by {
            None => {
                "parts of the truth cannot tell this score; raise --samples-per-pixel".to_owned()
            }
            Some(MOST_SAMPLES..) => {
                "too close to the limit for any number of samples; move the limit".to_owned()
            }
            Some(samples) => format!("--samples-per-pixel {samples} would settle it"),
        }),
        _ => None,
    }
}

pub(super) fn comparison_line(comparison: &Comparison) -> String {
    let Comparison {
        filter,
        metric,
        scenes,
        worse,
        bounds: [low, high],
        margin,
        ..
    } = comparison;
    let scenes = match scenes {
        1 => "1 scene".to_owned(),
        count => format!("{count} scenes"),
    };
    format!(
        "{}: {filter} {metric}, worse by {} over {scenes}, one-sided 95 % bounds {} and {}; margin {}",
        comparison.kind.words(),
        number(*worse),
        number(*low),
        number(*high),
        number(*margin)
    )
}

fn counts(check: &Check) -> String {
    let count = |kind| check.count(kind);
    let mut text = format!(
        "{} bounds: {} kept, {} broken, {} inconclusive, {} too strict, {} not applicable\n",
        check.findings.len(),
        count(Kind::Kept),
        count(Kind::Broken),
        count(Kind::Inconclusive),
        count(Kind::TooNoisy),
        count(Kind::NotApplicable)
    );
    if !check.findings.is_empty() {
        let required = (check.findings.iter()).filter(|finding| finding.level == Level::Required);
        text += &format!("{} of them required\n", required.count());
    }
    text
}
