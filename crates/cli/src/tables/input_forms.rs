//! Table of what each form of the input costs each filter.

use judge::list_summarized;
use metrics::Metric;
use suite::{Case, InputFormat};

use super::{abreast_text, list_once, mean_text};

/// Makes a row per form of the input and a column per filter: the change of mean FLIP against the full form. Empty for a run that
/// tried no other form. Rules of the shutter, which change nothing at the frame rate of the scenes' files, stand in the table of
/// rates.
pub fn input_forms_text(cases: &[Case]) -> String {
    let cases = list_summarized(cases);
    let is_shown = |case: &&&Case| case.rate.is_some() || case.input.rule == Default::default();
    let shown = cases.iter().filter(is_shown);
    let changes = list_once(shown.filter_map(|case| case.input.change()));
    if changes.is_empty() {
        return String::new();
    }
    let is_full = |case: &&&Case| !case.is_reference && case.input == InputFormat::default();
    let full: Vec<&&Case> = cases.iter().filter(is_full).collect();
    let names = list_once(full.iter().map(|case| case.name()));
    // Over the scenes that have both scores.
    let cost = |change: &String, name: &String| {
        let changed = format!("{name} {change}");
        let own = full.iter().filter(|case| case.name() == *name);
        let costs = own.filter_map(|own| {
            let mut others = cases.iter().filter(|case| case.scene == own.scene);
            let other = others.find(|case| case.name() == changed)?;
            Some(other.estimate(Metric::FLIP)? - own.estimate(Metric::FLIP)?)
        });
        mean_text(costs, |cost| format!("{cost:+.3}"))
    };
    let legend = "Change of the mean FLIP against the full form of the input; + is worse.";
    abreast_text(
        "form of the input",
        &names,
        &changes,
        String::clone,
        cost,
        legend,
    )
}
