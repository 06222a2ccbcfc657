//! Text for GitHub Actions: annotations, and the summary of a step.

use std::path::Path;

use crate::check::Check;
use judge::{Decision, Finding, number};
use measure::{escape_markdown, printable};
use report::{finding_line, length_text, limit_text, way_out};

use super::{comparison_line, count_lines, markdown_table, range_text};

/// GitHub's upper limit on the annotations of a step.
const MAX_ANNOTATIONS: usize = 10;
/// Upper limit on rows of a summary: people read it, and GitHub accepts one mebibyte per step.
const MAX_ROWS: usize = 500;

/// Formats one workflow command per line for each thing that keeps the check from passing. The
/// tenth counts the rest.
pub fn annotations(check: &Check) -> String {
    let findings = (check.findings.iter())
        .filter(|finding| finding.decision() != Decision::Pass)
        .map(|finding| {
            let title = format!("{} / {}", finding.scene, finding.filter);
            let suffix = way_out(finding).map(|way_out| format!("; {way_out}"));
            Annotation {
                place: file_place(&finding.place),
                title,
                message: finding_line(finding) + &suffix.unwrap_or_default(),
            }
        });
    let comparisons = (check.comparisons.iter())
        .filter(|comparison| comparison.decision() != Decision::Pass)
        .map(|comparison| Annotation {
            place: None,
            title: comparison.filter.clone(),
            message: comparison_line(comparison),
        });
    let failures = check.failures.iter().map(|failure| {
        let title = format!("{} / {}", failure.scene, failure.filter);
        Annotation {
            place: None,
            title,
            message: format!("FAILED {}", failure.reason),
        }
    });
    let mut all: Vec<Annotation> = failures.chain(findings).chain(comparisons).collect();
    if all.len() > MAX_ANNOTATIONS {
        let more = all.split_off(MAX_ANNOTATIONS - 1).len();
        let more = format!("and {more} more: see the summary");
        all.push(Annotation {
            place: None,
            title: "shuttertruth".to_owned(),
            message: more,
        });
    }
    all.iter().map(Annotation::line).collect()
}

/// An error that GitHub shows with a change.
struct Annotation {
    /// File and line; none if no file of the repository causes the error.
    place: Option<(String, String)>,
    title: String,
    message: String,
}

impl Annotation {
    /// Formats the workflow command.
    fn line(&self) -> String {
        let place = self.place.as_ref().map(|(file, line)| {
            let [file, line] = [file, line].map(|text| escape_property(text));
            format!("file={file},line={line},")
        });
        format!(
            "::error {}title={}::{}\n",
            place.unwrap_or_default(),
            escape_property(&self.title),
            escape_message(&self.message)
        )
    }
}

/// Splits the place of a bound into file and line; none for the program's own bounds.
fn file_place(place: &str) -> Option<(String, String)> {
    let (file, line) = place.rsplit_once(':')?;
    let file = file.strip_prefix("./").unwrap_or(file);
    (Path::new(file).is_file()).then(|| (file.to_owned(), line.to_owned()))
}

/// Makes the summary of the step, as Markdown.
pub fn summary(check: &Check) -> String {
    let mut text = format!(
        "## Shuttertruth: {}\n\n{}\n\n",
        check.decision.word(),
        (count_lines(check).iter().map(|line| escape_markdown(line)))
            .collect::<Vec<_>>()
            .join("\n\n")
    );
    for failure in &check.failures {
        let case = format!("{} / {}", failure.scene, failure.filter);
        let [case, reason] = [&case, &failure.reason].map(|text| escape_markdown(text));
        text += &format!("- **{case} failed**: {reason}\n\n");
    }
    let notable: Vec<&Finding> = (check.findings.iter())
        .filter(|finding| finding.outcome.is_notable())
        .collect();
    if !notable.is_empty() {
        let titles = [
            "scene",
            "filter",
            "metric",
            "value",
            "95 %",
            "limit",
            "floor",
            "worst at",
            "most like",
            "",
        ];
        let rows = notable.iter().take(MAX_ROWS);
        text += &markdown_table(&titles, rows.map(|finding| summary_row(finding)));
    }
    if notable.len() > MAX_ROWS {
        text += &format!("\nand {} more\n", notable.len() - MAX_ROWS);
    }
    if !check.comparisons.is_empty() {
        text += "\n### Comparison with the baseline\n\n";
        for comparison in &check.comparisons {
            text += &format!("- {}\n", escape_markdown(&comparison_line(comparison)));
        }
    }
    text
}

fn summary_row(finding: &Finding) -> Vec<String> {
    let value = finding.value.map(|value| finding.with_unit(value));
    let interval = finding.interval.as_ref();
    let interval = interval.map(|interval| range_text([interval.low, interval.high], number));
    let worst = match (&finding.worst, finding.worst_frame) {
        (Some(worst), _) => Some(format!("({}, {})", worst.x, worst.y)),
        (None, frame) => frame.map(|frame| format!("frame {frame}")),
    };
    let alike = finding.resembles.as_ref();
    let cells = [
        finding.scene.to_string(),
        finding.filter.clone(),
        metric_cell(finding),
        value.unwrap_or_default(),
        interval.unwrap_or_default(),
        limit_text(finding),
        finding.floor.map(number).unwrap_or_default(),
        worst.unwrap_or_default(),
        alike.map(|alike| alike.decoy.clone()).unwrap_or_default(),
        decision_word(finding.decision()).to_owned(),
    ];
    cells.map(|text| escape_markdown(&text)).to_vec()
}

/// Names the metric, and the length of the sequence.
fn metric_cell(finding: &Finding) -> String {
    match length_text(finding) {
        None => finding.metric.name(),
        Some(length) => format!("{} over {length}", finding.metric),
    }
}

fn decision_word(decision: Decision) -> &'static str {
    match decision {
        Decision::Pass => "target",
        Decision::Inconclusive => "undecided",
        Decision::Broken => "broken",
        Decision::Misconfigured => "misconfigured",
    }
}

/// Escapes the message of a workflow command.
fn escape_message(text: &str) -> String {
    let lines: Vec<_> = text.split('\n').map(printable).collect();
    lines.join("\n").replace('%', "%25").replace('\n', "%0A")
}

/// Escapes a property of a workflow command.
fn escape_property(text: &str) -> String {
    escape_message(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_end_a_command_is_escaped() {
        assert_eq!(escape_message("95 %\nof it: a, b"), "95 %25%0Aof it: a, b");
        assert_eq!(escape_property("a:b, 5 %"), "a%3Ab%2C 5 %25");
        assert_eq!(escape_message("a\r\u{1b}[2J"), "a\\r\\u001b[2J");
    }
}
