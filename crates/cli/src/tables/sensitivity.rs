//! Table of a sensitivity study.

use suite::{ParameterSensitivity, Sensitivity, SobolIndices};

use super::columns::number_table;

/// Makes the table of parameters, those that matter most first.
pub fn sensitivity_table(found: &Sensitivity) -> String {
    let mut rows: Vec<(&String, &ParameterSensitivity)> = found.parameters.iter().collect();
    rows.sort_by(|(_, a), (_, b)| b.importance().total_cmp(&a.importance()));
    let mut table = number_table(&["parameter", "first order", "total", "95 % CI", "constant?"]);
    for (name, it) in rows {
        let (first, total, interval) = match it.indices {
            Some(SobolIndices { first, total }) => (
                format!("{:.3}", first.value),
                format!("{:.3}", total.value),
                format!("{:.3} to {:.3}", total.low, total.high),
            ),
            None => ("-".to_owned(), "-".to_owned(), "-".to_owned()),
        };
        let constant = if it.constant { "yes" } else { "no" };
        table.push(vec![
            name.clone(),
            first,
            total,
            interval,
            constant.to_owned(),
        ]);
    }
    table.text() + &format!("{} candidates, {} failed\n", found.candidates, found.failed)
}
