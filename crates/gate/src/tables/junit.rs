//! JUnit XML of a check: one suite per scene, one case per filter and bound.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

use crate::check::Check;
use judge::{Decision, Finding, Level, Outcome};
use measure::printable_path;
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use report::{finding_line, way_out, worst_frame_text};

use super::comparison_line;
use scene::SceneId;

/// Makes the document. Failed cases and broken required bounds are failures; inconclusive ones and
/// limits within the noise are errors; the rest that did not pass is skipped: not applicable, not
/// judged, or broken but only reported. A case that did not pass names its picture, below the run's
/// `folder`, in the form that CI services show as an attachment. Each scene has its `seconds`.
pub fn junit(check: &Check, folder: &Path, seconds: &BTreeMap<SceneId, f64>) -> String {
    let mut suites: Vec<TestSuite> = Vec::new();
    let mut add = |suite: &str, filter: &str, what: &str, status: TestCaseStatus, picture| {
        let mut case = TestCase::new(format!("{filter} {what}"), status);
        case.set_classname(format!("{suite}.{filter}"));
        if let Some(picture) = picture {
            case.set_system_out(format!("[[ATTACHMENT|{picture}]]"));
        }
        let known = suites
            .iter()
            .position(|earlier| earlier.name.as_str() == suite);
        let index = known.unwrap_or_else(|| {
            suites.push(TestSuite::new(suite));
            suites.len() - 1
        });
        suites[index].add_test_case(case);
    };
    for finding in &check.findings {
        let (scene, metric) = (finding.scene.to_string(), finding.metric.name());
        let picture = picture_path(finding, folder);
        add(&scene, &finding.filter, &metric, status(finding), picture);
    }
    for failure in &check.failures {
        let status = with_message(NonSuccessKind::Failure, "failed", failure.reason.clone());
        let scene = failure.scene.to_string();
        add(&scene, &failure.filter, "runs", status, None);
    }
    for comparison in &check.comparisons {
        let line = comparison_line(comparison);
        let status = match comparison.decision() {
            Decision::Pass => TestCaseStatus::success(),
            Decision::Broken => with_message(NonSuccessKind::Failure, "worse", line),
            _ => with_message(NonSuccessKind::Error, "inconclusive", line),
        };
        add(
            "baseline",
            &comparison.filter,
            &comparison.metric.to_string(),
            status,
            None,
        );
    }
    let mut report = Report::new("shuttertruth check");
    for suite in &mut suites {
        let of_suite = (seconds.iter()).find(|(scene, _)| suite.name.as_str() == scene.to_string());
        if let Some((_, seconds)) = of_suite {
            suite.set_time(Duration::from_secs_f64(*seconds));
        }
    }
    if !seconds.is_empty() {
        report.set_time(Duration::from_secs_f64(seconds.values().sum()));
    }
    report.add_test_suites(suites);
    report.to_string().expect("a report in memory is written")
}

/// Returns the picture of a score that did not pass: the worst place if it is known, or the output.
fn picture_path(finding: &Finding, folder: &Path) -> Option<String> {
    if !finding.outcome.is_notable() {
        return None;
    }
    let worst = (finding.worst.as_ref()).map(|worst| worst.picture.clone());
    let picture = worst.unwrap_or_else(|| finding.pictures.join("output.png"));
    Some(printable_path(&folder.join(picture)))
}

fn status(finding: &Finding) -> TestCaseStatus {
    let worst = finding.worst.as_ref();
    let parts = [
        way_out(finding),
        worst.map(|worst| format!("worst at ({}, {})", worst.x, worst.y)),
        worst_frame_text(finding),
        (finding.resembles.as_ref()).map(|alike| format!("most like {}", alike.decoy)),
    ];
    let parts = std::iter::once(finding_line(finding)).chain(parts.into_iter().flatten());
    let message = parts.collect::<Vec<_>>().join("; ");
    match (finding.outcome, finding.level) {
        (Outcome::Kept, _) => TestCaseStatus::success(),
        (Outcome::Broken, Level::Required) => {
            with_message(NonSuccessKind::Failure, "broken", message)
        }
        (Outcome::Inconclusive, Level::Required) => {
            with_message(NonSuccessKind::Error, "inconclusive", message)
        }
        (Outcome::TooNoisy, Level::Required) => {
            with_message(NonSuccessKind::Error, "limit_within_noise", message)
        }
        (Outcome::Broken | Outcome::Inconclusive | Outcome::TooNoisy, Level::Report) => {
            skipped(message)
        }
        (Outcome::NotApplicable | Outcome::NotJudged, _) => {
            skipped(finding.reason.clone().unwrap_or_default())
        }
    }
}

fn with_message(kind: NonSuccessKind, word: &str, message: String) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(kind);
    status.set_message(message).set_type(word);
    status
}

fn skipped(message: String) -> TestCaseStatus {
    let mut status = TestCaseStatus::skipped();
    status.set_message(message);
    status
}
