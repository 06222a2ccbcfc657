//! Acceptance of a run's scores as the baseline.

use glob::Pattern;
use measure::{Case, Error, Run};
use metrics::Metric;

use crate::baseline::{BASELINE_FORMAT, Baseline};
use judge::round_to_digits;

/// Significant digits of a score: readable, and finer than any margin.
const DIGITS: usize = 6;

/// Rounds a score as a baseline has it.
pub(super) fn round_score(value: f64) -> f64 {
    round_to_digits(value, DIGITS)
}

/// Options of accepting a run.
pub struct Acceptance<'a> {
    /// Pattern of the cases to accept, by `scene/filter:preset`; none for all.
    pub only: Option<&'a Pattern>,
    /// Reason, in one line.
    pub reason: &'a str,
    /// True to accept another class of adapter than the baseline's.
    pub forced: bool,
}

impl Acceptance<'_> {
    /// Returns whether a case is accepted; references never are.
    pub fn includes(&self, case: &Case) -> bool {
        let name = format!("{}/{}", case.scene, case.name());
        !case.is_reference && self.only.is_none_or(|only| only.matches(&name))
    }
}

/// Makes a baseline from a run, and from the old one if only some cases are accepted.
pub fn accept_scores(
    run: &Run,
    old: Option<Baseline>,
    how: &Acceptance,
) -> Result<Baseline, Error> {
    if let Some(old) = &old
        && !how.forced
    {
        check_adapter(run, old, how.only.is_some())?;
    }
    let cases: Vec<&Case> = (run.cases.iter())
        .filter(|case| how.includes(case))
        .collect();
    if cases.is_empty() {
        let names = (run.cases.iter().filter(|case| !case.is_reference))
            .map(|case| format!("{}/{}", case.scene, case.name()));
        return refuse(&format!(
            "{} matches no case of the run; it has {}",
            how.only.map_or("*", Pattern::as_str),
            names.collect::<Vec<_>>().join(", ")
        ));
    }
    let old = old.filter(|_| how.only.is_some());
    let mut baseline = Baseline {
        format: BASELINE_FORMAT,
        program: run.program.clone(),
        adapter: run.adapter.clone(),
        ..old.unwrap_or_default()
    };
    baseline.reasons.push(how.reason.to_owned());
    for case in cases {
        add_case(&mut baseline, case)?;
    }
    Ok(baseline)
}

fn add_case(baseline: &mut Baseline, case: &Case) -> Result<(), Error> {
    let truths = baseline.truths.entry(case.scene.clone()).or_default();
    let old = truths.insert(case.alignment, case.truth_hash.clone());
    if old.is_some_and(|old| old != case.truth_hash) {
        return refuse(&format!(
            "{} ({}): the truth is another than the baseline's, and accepting some cases alone would leave scores of both; accept \
             the whole run",
            case.scene, case.alignment
        ));
    }
    let scores = (Metric::all().into_iter()).filter_map(|metric| {
        let value = case.scores.get(metric).value()?;
        Some((metric, round_score(value)))
    });
    let filters = baseline.scores.entry(case.scene.clone()).or_default();
    filters.insert(case.name(), scores.collect());
    Ok(())
}

/// Refuses another class of adapter than the baseline's and, if only some scores are replaced,
/// another adapter.
fn check_adapter(run: &Run, old: &Baseline, some: bool) -> Result<(), Error> {
    let [adapter, allowed] = [&run.adapter, &old.adapter].map(|adapter| match adapter {
        Some(adapter) => format!(
            "{} ({}, {}, {})",
            adapter.name, adapter.backend, adapter.driver, adapter.kind
        ),
        None => "none".to_owned(),
    });
    if !old.is_of_class(&run.adapter) {
        return refuse(&format!(
            "the run's adapter is {adapter}, the baseline's {allowed}: another class; run on one of that class, keep a baseline \
             for each, or force it"
        ));
    }
    if some && run.adapter != old.adapter {
        return refuse(&format!(
            "the run's adapter is {adapter}, the baseline's {allowed}, and accepting some cases alone would mix their scores; accept \
             the whole run, or force it"
        ));
    }
    Ok(())
}

fn refuse<T>(reason: &str) -> Result<T, Error> {
    Err(Error::Refused(reason.to_owned()))
}
