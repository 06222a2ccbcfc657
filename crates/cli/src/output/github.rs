//! A check for GitHub Actions: annotations, and the summary of a step.

use std::fmt::Write;

use report::{finding_line, way_out};

use crate::tables::check::comparison_line;
use suite::printable;
use suite::{Check, Decision};
use suite::{Finding, Outcome, number};

/// More than that, GitHub shows of no step.
const MOST_ANNOTATIONS: usize = 10;
/// A summary is to be read, and a step may have one mebibyte.
const MOST_ROWS: usize = 500;

/// Workflow commands, one a line, for what keeps the check from passing; the last of ten says how many more there are.
pub fn annotations(check: &Check) -> String {
    let findings = (check.findings.iter())
        .filter(|finding| finding.decision() != Decision::Pass)
        .map(|finding| {
            let title = format!("{} / {}", finding.scene, finding.filter);
            let way_out = way_out(finding).map(|way_out| format!("; {way_out}"));
            (title, finding_line(finding) + &way_out.unwrap_or_default())
        });
    let comparisons = (check.comparisons.iter())
        .filter(|comparison| comparison.decision() != Decision::Pass)
        .map(|comparison| (comparison.filter.clone(), comparison_line(comparison)));
    let failures = check.failures.iter().map(|failure| {
        let title = format!("{} / {}", failure.scene, failure.filter);
        (title, format!("FAILED {}", failure.reason))
    });
    let mut all: Vec<(String, String)> = failures.chain(findings).chain(comparisons).collect();
    if all.len() > MOST_ANNOTATIONS {
        let more = all.len() - (MOST_ANNOTATIONS - 1);
        all.truncate(MOST_ANNOTATIONS - 1);
        all.push((
            "shuttertruth".to_owned(),
            format!("and {more} more: see the summary"),
        ));
    }
    all.iter()
        .map(|(title, message)| format!("::error title={}::{}\n", property(title), data(message)))
        .collect()
}

/// The step's summary, as Markdown.
pub fn summary(check: &Check) -> String {
    let mut text = format!("## Shuttertruth: {}\n\n", words(check.decision));
    let notable: Vec<&Finding> = (check.findings.iter())
        .filter(|finding| !matches!(finding.outcome, Outcome::Kept | Outcome::NotApplicable))
        .collect();
    let _ = writeln!(
        text,
        "{} bounds, {} kept, {} broken, {} inconclusive, {} too strict, {} not applicable\n",
        check.findings.len(),
        check.count(Outcome::Kept),
        check.count(Outcome::Broken),
        check.count(Outcome::Inconclusive),
        check.count(Outcome::TooNoisy),
        check.count(Outcome::NotApplicable),
    );
    for failure in &check.failures {
        let (scene, filter) = (cell(&failure.scene), cell(&failure.filter));
        let _ = writeln!(
            text,
            "- **{scene} / {filter} failed**: {}\n",
            cell(&failure.reason)
        );
    }
    if !notable.is_empty() {
        text +=
            "| scene | filter | metric | value | 95 % | limit | floor | worst at | most like | |\n";
        text += "|---|---|---|---|---|---|---|---|---|---|\n";
    }
    for finding in notable.iter().take(MOST_ROWS) {
        text += &row(finding);
    }
    if notable.len() > MOST_ROWS {
        let _ = writeln!(text, "\nand {} more", notable.len() - MOST_ROWS);
    }
    if !check.comparisons.is_empty() {
        text += "\n### Compared with the baseline\n\n";
        for comparison in &check.comparisons {
            let _ = writeln!(text, "- {}", cell(&comparison_line(comparison)));
        }
    }
    text
}

fn row(finding: &Finding) -> String {
    let or_none = |text: Option<String>| text.unwrap_or_default();
    let interval = (finding.interval.as_ref())
        .map(|interval| format!("{} to {}", number(interval.low), number(interval.high)));
    let cells = [
        finding.scene.clone(),
        finding.filter.clone(),
        finding.metric.clone(),
        or_none(finding.value.map(|value| finding.with_unit(value))),
        or_none(interval),
        number(finding.limit),
        or_none(finding.floor.map(number)),
        or_none((finding.worst.as_ref()).map(|worst| format!("({}, {})", worst.x, worst.y))),
        or_none((finding.resembles.as_ref()).map(|alike| alike.decoy.clone())),
        match finding.decision() {
            Decision::Pass => "reported".to_owned(),
            decision => words(decision).to_owned(),
        },
    ];
    format!("| {} |\n", cells.map(|text| cell(&text)).join(" | "))
}

fn words(decision: Decision) -> &'static str {
    match decision {
        Decision::Pass => "pass",
        Decision::Inconclusive => "inconclusive",
        Decision::Broken => "broken",
        Decision::Misconfigured => "misconfigured",
    }
}

/// A vertical bar would end the cell, and other signs make links or pictures of names.
fn cell(text: &str) -> String {
    let one_line = text.replace('\n', " ");
    let mut cell = String::new();
    for letter in printable(&one_line).chars() {
        if MARKDOWN.contains(letter) {
            cell.push('\\');
        }
        cell.push(letter);
    }
    cell
}

/// Letters that Markdown reads as more than themselves: an image in a name would be fetched, HTML be shown.
const MARKDOWN: &str = "\\`|*<[&";

/// What a workflow command's message escapes.
fn data(text: &str) -> String {
    let lines: Vec<_> = text.split('\n').map(printable).collect();
    lines.join("\n").replace('%', "%25").replace('\n', "%0A")
}

/// What a workflow command's property escapes.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_end_a_command_is_escaped() {
        assert_eq!(data("95 %\nof it: a, b"), "95 %25%0Aof it: a, b");
        assert_eq!(property("a:b, 5 %"), "a%3Ab%2C 5 %25");
        assert_eq!(data("a\r\u{1b}[2J"), "a\\r\\u001b[2J");
    }

    #[test]
    fn names_make_no_pictures_in_a_summary() {
        assert_eq!(
            cell("![a](b)<img src=c> `d`\ne|f"),
            "!\\[a](b)\\<img src=c> \\`d\\` e\\|f"
        );
    }
}
