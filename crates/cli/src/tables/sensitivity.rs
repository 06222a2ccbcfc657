//! Table of a sensitivity study.

use suite::{ParameterSensitivity, Sensitivity, SobolIndices};

/// Makes the table of parameters, those that matter most first.
pub fn sensitivity_table(found: &Sensitivity) -> String {
    let mut rows: Vec<(&String, &ParameterSensitivity)> = found.parameters.iter().collect();
    rows.sort_by(|(_, a), (_, b)| b.importance().total_cmp(&a.importance()));
    let width = found.parameters.keys().map(String::len).max().unwrap_or(0);
    let width = width.max("parameter".len());
    let mut text = format!(
        "{:width$}  effect  spread  first  total (95 %)           constant?\n",
        "parameter"
    );
    for (name, it) in rows {
        let effects = match it.effects {
            Some(effects) => format!("{:7.3} {:7.3}", effects.mean_size, effects.deviation),
            None => format!("{:>7} {:>7}", "-", "-"),
        };
        let indices = match it.indices {
            Some(SobolIndices { first, total }) => format!(
                "{:6.3} {:6.3} ({:6.3} to {:5.3})",
                first.value, total.value, total.low, total.high
            ),
            None => format!("{:>6} {:>6} {:18}", "-", "-", ""),
        };
        let constant = if it.constant { "yes" } else { "no" };
        text += &format!("{name:width$} {effects} {indices}  {constant}\n");
    }
    text + &format!("{} candidates, {} failed\n", found.candidates, found.failed)
}
