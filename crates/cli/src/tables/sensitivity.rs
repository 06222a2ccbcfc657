//! Table of a sensitivity study.

use suite::{ParameterSensitivity, Sensitivity, SobolIndices};

/// Makes the table of parameters, those that matter most first.
pub fn sensitivity_table(found: &Sensitivity) -> String {
    let mut rows: Vec<(&String, &ParameterSensitivity)> = found.parameters.iter().collect();
    rows.sort_by(|(_, a), (_, b)| b.indices.total.value.total_cmp(&a.indices.total.value));
    let width = found.parameters.keys().map(String::len).max().unwrap_or(0);
    let width = width.max("parameter".len());
    let mut text = format!(
        "{:width$}  first  total (95 %)           constant?\n",
        "parameter"
    );
    for (name, own) in rows {
        let SobolIndices { first, total } = own.indices;
        let constant = if own.constant { "yes" } else { "no" };
        text += &format!(
            "{name:width$} {:6.3} {:6.3} ({:6.3} to {:5.3})  {constant}\n",
            first.value, total.value, total.low, total.high
        );
    }
    text + &format!("{} candidates, {} failed\n", found.candidates, found.failed)
}
