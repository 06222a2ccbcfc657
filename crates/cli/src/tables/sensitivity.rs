//! Table of a sensitivity study.

use tune::{ParameterSensitivity, Sensitivity, SobolIndices};

use super::Table;

/// Makes the table of parameters, those that matter most first.
pub fn sensitivity_table(found: &Sensitivity) -> String {
    let mut rows: Vec<(&String, &ParameterSensitivity)> = found.parameters.iter().collect();
    rows.sort_by(|(_, a), (_, b)| b.indices.total.value.total_cmp(&a.indices.total.value));
    let mut table = Table::new(
        "parameter",
        ["first order", "total", "95 % CI", "constant?"],
    );
    for (name, own) in rows {
        let SobolIndices { first, total } = own.indices;
        let constant = if own.constant { "yes" } else { "no" };
        let cells = [
            format!("{:.3}", first.value),
            format!("{:.3}", total.value),
            format!("{:.3} to {:.3}", total.low, total.high),
            constant.to_owned(),
        ];
        table.push(name, cells);
    }
    table.text() + &format!("{} candidates, {} failed\n", found.candidates, found.failed)
}
