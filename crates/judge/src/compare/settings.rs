//! Differences between the settings of two runs.

use std::collections::BTreeSet;

use filters::AdapterDescription;
use measure::{Case, Run, list_settings};
use serde::Serialize;

use crate::compare::pairing::Pair;

/// One setting with two values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SettingChange {
    /// `adapter`, or `jump_flood:paper.samples`.
    pub name: String,
    /// Value in the first run; empty if it has none.
    pub first: String,
    /// Value in the second run.
    pub second: String,
}

/// Compares the settings of the runs, then the parameters of the filters that both have.
pub fn compare_settings(first: &Run, second: &Run, pairs: &[Pair]) -> Vec<SettingChange> {
    let of_runs = run_settings(first).into_iter().zip(run_settings(second));
    let of_runs = of_runs.map(|((name, first), (_, second))| (name.to_owned(), [first, second]));
    let mut known = BTreeSet::new();
    (of_runs.chain(pairs.iter().flat_map(list_parameters)))
        .filter(|setting| setting.1[0] != setting.1[1] && known.insert(setting.clone()))
        .map(|(name, [first, second])| SettingChange {
            name,
            first,
            second,
        })
        .collect()
}

fn run_settings(run: &Run) -> Vec<(&'static str, String)> {
    let mut settings = vec![
        ("program", run.program.clone()),
        ("adapter", adapter_label(&run.adapter)),
    ];
    settings.extend(list_settings(&run.render));
    settings
}

fn adapter_label(adapter: &Option<AdapterDescription>) -> String {
    match adapter {
        Some(adapter) => format!(
            "{}, {}, driver {}",
            adapter.name, adapter.backend, adapter.driver
        ),
        None => "none".to_owned(),
    }
}

/// Lists the parameters of either case by name, with both values.
fn list_parameters(pair: &Pair) -> Vec<(String, [String; 2])> {
    let cases = [pair.first, pair.second];
    let name = pair.first.name();
    let width = |case: &Case| match case.reference_width {
        Some(width) => format!("{width} px"),
        None => "as written".to_owned(),
    };
    let value = |case: &Case, parameter| {
        let value = case.parameters.get(parameter);
        value.map_or_else(String::new, ToString::to_string)
    };
    let parameters: BTreeSet<&String> = (cases.iter())
        .flat_map(|case| case.parameters.keys())
        .collect();
    let values = parameters.into_iter().map(|parameter| {
        let both = cases.map(|case| value(case, parameter));
        (format!("{name}.{parameter}"), both)
    });
    let widths = (format!("{name} reference width"), cases.map(width));
    std::iter::once(widths).chain(values).collect()
}
