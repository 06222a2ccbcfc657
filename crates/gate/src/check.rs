//! Check of a finished run: its findings and the resulting decision.

use std::collections::HashSet;

use measure::{Case, Error, Failure, Run, refuse_failures};
use scene::SceneId;
use serde::Serialize;

use crate::baseline::BaselineComparison;
use judge::{Decision, Finding, Outcome};

/// Version of the layout of a check as JSON.
pub const CHECK_FORMAT: u32 = 1;

/// Results of a check.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// [`CHECK_FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Resulting decision.
    pub decision: Decision,
    /// Cases that failed and have no scores.
    pub failures: Vec<Failure>,
    /// One per bounded score, in the order of the run.
    pub findings: Vec<Finding>,
    /// Comparisons with a baseline, one per filter and metric with a margin; empty without a
    /// baseline.
    pub comparisons: Vec<BaselineComparison>,
}

/// Decides on a finished run by its findings and, with a baseline, by the comparisons with it.
/// Pure: reads nothing, prints nothing.
pub fn check(run: &Run, findings: Vec<Finding>, comparisons: Vec<BaselineComparison>) -> Check {
    let applies =
        |finding: &Finding| !matches!(finding.outcome, Outcome::NotApplicable | Outcome::NotJudged);
    let bounds = findings.iter().map(Finding::decision);
    let baseline = comparisons.iter().map(BaselineComparison::decision);
    let judged: HashSet<(&SceneId, &str)> = (findings.iter().filter(|finding| applies(finding)))
        .map(|finding| (&finding.scene, finding.filter.as_str()))
        .collect();
    let is_judged = |case: &Case| judged.contains(&(&case.scene, case.name().as_str()));
    let unchecked = comparisons.is_empty()
        && (run.cases.iter()).any(|case| !case.is_reference && !is_judged(case));
    let unchecked = unchecked.then_some(Decision::Misconfigured);
    let failed = run.failures.iter().map(|_| Decision::Broken);
    Check {
        format: CHECK_FORMAT,
        program: run.program.clone(),
        decision: (bounds.chain(baseline).chain(failed).chain(unchecked))
            .max()
            .unwrap_or(Decision::Misconfigured),
        failures: run.failures.clone(),
        findings,
        comparisons,
    }
}

impl Check {
    /// Counts the findings with this outcome.
    pub fn count(&self, outcome: Outcome) -> usize {
        (self.findings.iter())
            .filter(|finding| finding.outcome == outcome)
            .count()
    }

    /// Returns the error that ends the command with the decision's exit code; none if the check
    /// passes.
    pub fn verdict(&self) -> Result<(), Error> {
        let bounds = self.findings.iter().map(Finding::decision);
        let bounds = bounds.filter(|decision| *decision == self.decision).count();
        let compared = self.comparisons.iter().map(BaselineComparison::decision);
        let compared = compared
            .filter(|decision| *decision == self.decision)
            .count();
        match self.decision {
            Decision::Pass => Ok(()),
            Decision::Inconclusive => Err(Error::Inconclusive(format!(
                "{} from the truth's noise; what settles it is said above",
                either(
                    counted(
                        bounds,
                        "a required score cannot be told",
                        "required scores cannot be told"
                    ),
                    counted(
                        compared,
                        "a change since the baseline cannot be told",
                        "changes since the baseline cannot be told"
                    ),
                )
            ))),
            Decision::Broken if !self.failures.is_empty() => refuse_failures(&self.failures),
            Decision::Broken => Err(Error::Broken(either(
                counted(
                    bounds,
                    "a required bound is broken",
                    "required bounds are broken",
                ),
                counted(
                    compared,
                    "a score is worse than the baseline's",
                    "scores are worse than the baseline's",
                ),
            ))),
            Decision::Misconfigured if bounds == 0 => Err(Error::Refused(
                "a case has no bound that applies, and cannot pass; see above".to_owned(),
            )),
            Decision::Misconfigured => Err(Error::Refused(format!(
                "{} stricter than three noise floors; raise the limit, or the samples per pixel, as said above",
                counted(bounds, "a bound is", "bounds are").unwrap_or_default()
            ))),
        }
    }
}

/// Words a count: `one` for 1, the number before `many` for more, none for 0.
fn counted(count: usize, one: &str, many: &str) -> Option<String> {
    match count {
        0 => None,
        1 => Some(one.to_owned()),
        count => Some(format!("{count} {many}")),
    }
}

/// Joins what is said of bounds and of comparisons.
fn either(bounds: Option<String>, comparisons: Option<String>) -> String {
    let said: Vec<String> = bounds.into_iter().chain(comparisons).collect();
    said.join(", and ")
}
