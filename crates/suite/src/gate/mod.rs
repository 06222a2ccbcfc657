//! From a finished run to pass or fail: what is broken, by how much, where, and what it is like.

mod finding;
mod github;
mod junit;
mod text;

use serde::Serialize;

use crate::baseline::Comparison;
use crate::failure::refuse_failures;
use crate::{Error, Failure, Run};

pub use finding::{Finding, Kind, findings, number};
pub use github::{annotations, summary};
pub use junit::junit;
pub use text::check_text;
pub(crate) use text::{headline, way_out};

/// Version of the layout of what `check --json` prints.
pub const CHECK_FORMAT: u32 = 1;

/// All that a check found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// [`CHECK_FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// What it comes to.
    pub decision: Decision,
    /// Cases that failed and have no scores.
    pub failures: Vec<Failure>,
    /// One per bounded score, in the order of the run.
    pub findings: Vec<Finding>,
    /// Against a baseline, one per filter and metric with a margin; empty without a baseline.
    pub comparisons: Vec<Comparison>,
}

/// What a check comes to; a later one outweighs an earlier one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Decision {
    /// Every required bound is kept.
    Pass,
    /// None is broken, but of some the truth cannot tell.
    Inconclusive,
    /// A required bound is broken, or a case failed.
    Broken,
    /// A bound is narrower than the truth's noise can carry, or a case has none that applies.
    Misconfigured,
}

/// Judges a finished run by its verdicts and, where there is a baseline, by the comparisons with it. Pure: reads nothing,
/// prints nothing.
pub fn check(run: &Run, comparisons: Vec<Comparison>) -> Check {
    let findings = findings(run);
    let bounds = findings.iter().map(Finding::decision);
    let baseline = comparisons.iter().map(Comparison::decision);
    let unchecked = match comparisons.is_empty() {
        true => (run.cases.iter())
            .any(|case| !case.bar && !findings.iter().any(|found| found.applies_to(case))),
        false => false,
    };
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
    /// How many findings are of a kind.
    pub fn count(&self, kind: Kind) -> usize {
        (self.findings.iter())
            .filter(|finding| finding.kind == kind)
            .count()
    }

    /// The error that ends the command with the decision's exit code; none where it passes.
    pub fn verdict(&self) -> Result<(), Error> {
        let count = |decision: Decision, one: &str, many: &str| {
            let bounds = self.findings.iter().map(Finding::decision);
            let all = bounds.chain(self.comparisons.iter().map(Comparison::decision));
            match all.filter(|found| *found == decision).count() {
                1 => one.to_owned(),
                count => format!("{count} {many}"),
            }
        };
        match self.decision {
            Decision::Pass => Ok(()),
            Decision::Inconclusive => Err(Error::Inconclusive(format!(
                "{} cannot be told from the truth's noise; raise --samples-per-pixel as said above",
                count(self.decision, "a required score", "required scores")
            ))),
            Decision::Broken if !self.failures.is_empty() => refuse_failures(&self.failures),
            Decision::Broken => Err(Error::Broken(format!(
                "{} broken",
                count(self.decision, "a required bound is", "required bounds are")
            ))),
            Decision::Misconfigured => Err(Error::Usage(
                match count(self.decision, "a bound is", "bounds are") {
                    none if none.starts_with("0 ") => {
                        "a case has no bound that applies, and no check is no success; see above"
                            .to_owned()
                    }
                    some => format!(
                        "{some} stricter than three noise floors; raise the limit, or --samples-per-pixel, as said above"
                    ),
                },
            )),
        }
    }
}
