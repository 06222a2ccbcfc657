//! Making the scores of a run the ones to be compared with.

use std::collections::BTreeMap;

use glob::Pattern;
use metrics::Metric;

use super::{BASELINE_FORMAT, Baseline};
use crate::{Case, Error, Run};

/// How a run is accepted.
pub struct Acceptance<'a> {
    /// Of which cases, by `scene/filter:preset`; none for all.
    pub only: Option<&'a Pattern>,
    /// Why, in one line.
    pub reason: &'a str,
    /// Whether another class of adapter than the baseline's will do.
    pub forced: bool,
}

/// The baseline that a run makes of the one before, if there was one. Without `only` nothing is left of that.
pub fn accept(run: &Run, old: Option<Baseline>, how: &Acceptance) -> Result<Baseline, Error> {
    let reason = how.reason.trim();
    if reason.is_empty() || reason.contains('\n') {
        return refuse("--reason: needs one line on why these scores are right");
    }
    if let Some(old) = &old
        && !how.forced
    {
        check_adapter(run, old, how.only.is_some())?;
    }
    let wanted = |case: &&Case| {
        let name = format!("{}/{}", case.scene, case.name());
        !case.is_reference && how.only.is_none_or(|only| only.matches(&name))
    };
    let cases: Vec<&Case> = run.cases.iter().filter(wanted).collect();
    if cases.is_empty() {
        let names = (run.cases.iter().filter(|case| !case.is_reference))
            .map(|case| format!("{}/{}", case.scene, case.name()));
        return refuse(&format!(
            "--only matches no case of the run; it has {}",
            names.collect::<Vec<_>>().join(", ")
        ));
    }
    let kept = old.filter(|_| how.only.is_some());
    let mut baseline = Baseline {
        format: BASELINE_FORMAT,
        program: run.program.clone(),
        adapter: run.adapter.clone(),
        ..kept.unwrap_or_else(|| Baseline {
            format: BASELINE_FORMAT,
            program: String::new(),
            adapter: None,
            reasons: Vec::new(),
            truths: BTreeMap::new(),
            scores: BTreeMap::new(),
        })
    };
    baseline.reasons.push(reason.to_owned());
    for case in cases {
        add(&mut baseline, case)?;
    }
    Ok(baseline)
}

fn add(baseline: &mut Baseline, case: &Case) -> Result<(), Error> {
    let truths = baseline.truths.entry(case.scene.clone()).or_default();
    let old = truths.insert(case.alignment.clone(), case.truth_hash.clone());
    if old.is_some_and(|old| old != case.truth_hash) {
        return refuse(&format!(
            "{} ({}): the truth is another than the baseline's, and --only would leave scores of both; accept the whole run, \
             without --only",
            case.scene, case.alignment
        ));
    }
    let scores = (Metric::all().into_iter())
        .filter_map(|metric| Some((metric.name(), rounded(case.scores.get(metric).value()?))));
    let filters = baseline.scores.entry(case.scene.clone()).or_default();
    filters.insert(case.name(), scores.collect());
    Ok(())
}

/// To six significant digits: what a person can read, and finer than any margin.
fn rounded(value: f64) -> f64 {
    (format!("{value:.5e}").parse()).expect("a number as text is a number")
}

/// Refuses another class of adapter than the baseline's and, where only some scores are replaced, another adapter.
fn check_adapter(run: &Run, old: &Baseline, some: bool) -> Result<(), Error> {
    let [found, allowed] = [&run.adapter, &old.adapter].map(|adapter| match adapter {
        Some(adapter) => format!(
            "{} ({}, {}, {})",
            adapter.name, adapter.backend, adapter.driver, adapter.kind
        ),
        None => "none".to_owned(),
    });
    if !old.is_of_class(&run.adapter) {
        return refuse(&format!(
            "the run's adapter is {found}, the baseline's {allowed}: another class; run on one of that class, keep a baseline \
             for each, or add --force"
        ));
    }
    if some && run.adapter != old.adapter {
        return refuse(&format!(
            "the run's adapter is {found}, the baseline's {allowed}, and --only would mix their scores; accept the whole run, \
             without --only, or add --force"
        ));
    }
    Ok(())
}

fn refuse<T>(reason: &str) -> Result<T, Error> {
    Err(Error::Usage(reason.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_keep_six_digits() {
        assert_eq!(rounded(0.123_456_789), 0.123_457);
        assert_eq!(rounded(-1_234.567_89), -1_234.57);
        assert_eq!(rounded(0.0), 0.0);
    }
}
