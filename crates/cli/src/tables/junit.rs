//! JUnit XML of a check: one suite per scene, one case per filter and bound.

use judge::{Check, Decision, Finding, Level, Outcome};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use report::{finding_line, way_out, worst_frame_text};

use super::comparison_line;

/// Makes the document. A case that failed and a broken required bound are failures; an inconclusive one and one whose limit lies within the noise are
/// errors; what does not apply or was not judged, and what is broken but only reported, is skipped.
pub fn junit(check: &Check) -> String {
    let mut report = Report::new("shuttertruth check");
    let mut suites: Vec<TestSuite> = Vec::new();
    let mut add = |name: &str, case: TestCase| {
        match suites.iter_mut().find(|suite| suite.name.as_str() == name) {
            Some(suite) => drop(suite.add_test_case(case)),
            None => {
                let mut suite = TestSuite::new(name);
                suite.add_test_case(case);
                suites.push(suite);
            }
        };
    };
    for finding in &check.findings {
        let mut case = TestCase::new(
            format!("{} {}", finding.filter, finding.metric),
            status(finding),
        );
        case.set_classname(format!("{}.{}", finding.scene, finding.filter));
        add(&finding.scene.to_string(), case);
    }
    for failure in &check.failures {
        let reason = failure.reason.clone();
        let status = with_message(NonSuccessKind::Failure, "failed", reason);
        let mut case = TestCase::new(format!("{} runs", failure.filter), status);
        case.set_classname(format!("{}.{}", failure.scene, failure.filter));
        add(&failure.scene.to_string(), case);
    }
    for comparison in &check.comparisons {
        let line = comparison_line(comparison);
        let status = match comparison.decision() {
            Decision::Pass => TestCaseStatus::success(),
            Decision::Broken => with_message(NonSuccessKind::Failure, "worse", line),
            _ => with_message(NonSuccessKind::Error, "inconclusive", line),
        };
        let name = format!("{} {}", comparison.filter, comparison.metric);
        let mut case = TestCase::new(name, status);
        case.set_classname(format!("baseline.{}", comparison.filter));
        add("baseline", case);
    }
    report.add_test_suites(suites);
    report.to_string().expect("a report in memory is written")
}

fn status(finding: &Finding) -> TestCaseStatus {
    let mut message = finding_line(finding);
    message.extend(way_out(finding).map(|way_out| format!("; {way_out}")));
    if let Some(worst) = &finding.worst {
        message += &format!("; worst at ({}, {})", worst.x, worst.y);
    }
    if let Some(frame) = worst_frame_text(finding) {
        message += &format!("; {frame}");
    }
    if let Some(alike) = &finding.resembles {
        message += &format!("; most like {}", alike.decoy);
    }
    match (finding.outcome, finding.level) {
        (Outcome::Kept, _) => TestCaseStatus::success(),
        (Outcome::Broken, Level::Required) => {
            with_message(NonSuccessKind::Failure, "broken", message)
        }
        (Outcome::Inconclusive, Level::Required) => {
            with_message(NonSuccessKind::Error, "inconclusive", message)
        }
        (Outcome::TooNoisy, _) => {
            with_message(NonSuccessKind::Error, "limit_within_noise", message)
        }
        (Outcome::Broken | Outcome::Inconclusive, Level::Report) => skipped(message),
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
