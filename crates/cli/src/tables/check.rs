//! Text of a check: every score that does not keep its bound.

use std::fmt::Write;

use crate::output::colors::{bad, doubtful, good, heading};
use crate::output::wrap::push_wrapped;
use crate::tables::failures::failures_text;
use report::{finding_score, finding_status, way_out};
use suite::{BaselineComparison, Check, Finding, Level, Outcome, number, printable_path};

/// Lists scores that are broken, inconclusive or too noisy, by scene and filter; then comparisons, then counts. `out` is the
/// folder of the run's pictures.
pub fn check_text(check: &Check, out: &std::path::Path) -> String {
    let mut text = failures_text(&check.failures);
    let mut case = (String::new(), String::new());
    for finding in &check.findings {
        if matches!(finding.outcome, Outcome::Kept | Outcome::NotApplicable) {
            continue;
        }
        let own = (finding.scene.clone(), finding.filter.clone());
        if case != own {
            let _ = writeln!(text, "{}", heading(&format!("{} / {}", own.0, own.1)));
            case = own;
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
    text + &counts_text(check)
}

fn finding_lines(finding: &Finding, out: &std::path::Path) -> Vec<(usize, String)> {
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
    let scenes = match scenes {
        1 => "1 scene".to_owned(),
        count => format!("{count} scenes"),
    };
    format!(
        "{}: {filter} {metric}, worse by {} over {scenes}, one-sided 95 % bounds {} and {}; margin {}",
        comparison.kind.label(),
        number(*worse),
        number(*low),
        number(*high),
        number(*margin)
    )
}

fn counts_text(check: &Check) -> String {
    let mut text = format!(
        "{} bounds: {} kept, {} broken, {} inconclusive, {} too strict, {} not applicable\n",
        check.findings.len(),
        check.count(Outcome::Kept),
        check.count(Outcome::Broken),
        check.count(Outcome::Inconclusive),
        check.count(Outcome::TooNoisy),
        check.count(Outcome::NotApplicable)
    );
    if !check.findings.is_empty() {
        let required = (check.findings.iter()).filter(|finding| finding.level == Level::Required);
        text += &format!("{} of them required\n", required.count());
    }
    text
}
