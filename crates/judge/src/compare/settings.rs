//! Differences between the settings of two runs.

use std::collections::BTreeSet;

use filters::AdapterDescription;
use serde::Serialize;
use suite::{Case, Run, list_settings};

use crate::compare::pairing::Pair;

/// One setting with two values.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
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
    let mut all: Vec<SettingChange> = of_runs
        .map(|((name, first), (_, second))| SettingChange {
            name: name.to_owned(),
            first,
            second,
        })
        .collect();
    for pair in pairs {
        all.extend(compare_parameters(pair));
    }
    let mut known = BTreeSet::new();
    all.retain(|own| {
        own.first != own.second
            && known.insert((own.name.clone(), own.first.clone(), own.second.clone()))
    });
    all
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
        Some(own) => format!("{}, {}, driver {}", own.name, own.backend, own.driver),
        None => "none".to_owned(),
    }
}

fn compare_parameters(pair: &Pair) -> Vec<SettingChange> {
    let [first, second] = [pair.first, pair.second];
    let keys = first.parameters.keys().chain(second.parameters.keys());
    let names: BTreeSet<&String> = keys.collect();
    let value = |case: &Case, name| {
        let value = case.parameters.get(name);
        value.map_or_else(String::new, ToString::to_string)
    };
    let width = |case: &Case| match case.reference_width {
        Some(width) => format!("{width} px"),
        None => "as written".to_owned(),
    };
    let widths = SettingChange {
        name: format!("{} reference width", first.name()),
        first: width(first),
        second: width(second),
    };
    std::iter::once(widths)
        .chain(names.into_iter().map(|name| SettingChange {
            name: format!("{}.{name}", first.name()),
            first: value(first, name),
            second: value(second, name),
        }))
        .collect()
}
