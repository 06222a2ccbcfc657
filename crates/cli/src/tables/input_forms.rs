//! Table of what each form of the input costs each filter.

use judge::list_summarized;
use metrics::Metric;
use suite::{Case, InputFormat};

use super::{abreast_text, legend_text, list_once};

/// Makes a row per form of the input and a column per filter: the change of mean FLIP against the full form. Empty for a run that
/// tried no other form. Rules of the shutter, which change nothing at the frame rate of the scenes' files, stand in the table of
/// rates.
pub fn input_forms_text(cases: &[Case]) -> String {
    let cases = list_summarized(cases);
    let rates =
        |case: &&&Case| case.rate.is_some() || case.input.rule == InputFormat::default().rule;
    let changes: Vec<String> = cases
        .iter()
        .filter(rates)
        .filter_map(|case| case.input.change())
        .collect();
    let changes = list_once(changes.iter().map(String::as_str));
    if changes.is_empty() {
        return String::new();
    }
    let full: Vec<&Case> = (cases.iter())
        .filter(|case| !case.is_reference && case.input == InputFormat::default())
        .copied()
        .collect();
    let names: Vec<String> = full.iter().map(|case| case.name()).collect();
    let names = list_once(names.iter().map(String::as_str));
    let cell = |change: &&str, name: &str| {
        mean_cost(&cases, &full, name, change)
            .map_or("n/a".to_owned(), |cost| format!("{cost:+.3}"))
    };
    let name = |change: &&str| (*change).to_owned();
    let mut text = "\n".to_owned();
    text += &abreast_text("form of the input", &names, &changes, name, cell);
    text += "\n";
    text += &legend_text("Change of the mean FLIP against the full form of the input; + is worse.");
    text
}

/// Averages the change of FLIP over the scenes that have both scores.
fn mean_cost(cases: &[&Case], full: &[&Case], name: &str, change: &str) -> Option<f64> {
    let flip = |case: &Case| case.estimate(Metric::FLIP);
    let of_scene = |own: &&&Case| {
        let changed = format!("{name} {change}");
        let other =
            (cases.iter()).find(|case| case.scene == own.scene && case.name() == changed)?;
        Some(flip(other)? - flip(own)?)
    };
    let own = full.iter().filter(|case| case.name() == name);
    let costs: Vec<f64> = own.filter_map(|case| of_scene(&case)).collect();
    (!costs.is_empty()).then(|| costs.iter().sum::<f64>() / costs.len() as f64)
}
