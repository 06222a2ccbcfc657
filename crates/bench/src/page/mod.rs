//! Costs of filters on the page of a run.

mod costs;
mod pareto;
mod times;

use std::collections::HashMap;
use std::path::Path;

use costs::{TimedFilter, costs, no_costs};
use filters::Value;
use maud::html;
use measure::{Case, Error, Run};
use report::{Addition, CaseTable, FilterColumn, FilterNumber};
use times::milliseconds;

use crate::{Bench, CaseCost};

/// Name of the file that `shuttertruth bench` writes.
pub const BENCH_FILE: &str = "bench.json";

/// Makes the section on the costs of a run's filters, and the column of their times, from the
/// bench.json in the run's folder. Without such a file the section says how to make one.
pub fn add_costs(run: &Run, folder: &Path) -> Result<Addition, Error> {
    let table = CaseTable::new(run);
    let path = folder.join(BENCH_FILE);
    let bench = path.exists().then(|| Bench::read(&path)).transpose()?;
    let timed = bench.as_ref().map(|bench| list_timed(&table, bench));
    let content = match (&bench, &timed) {
        (Some(bench), Some(timed)) => costs(&table, bench, timed),
        _ => no_costs(),
    };
    Ok(Addition {
        section: html! { section.costs { h2 { "Costs" } (content) } },
        column: timed.map(|timed| make_column(&timed)),
    })
}

/// Makes the column of the filters' times.
fn make_column(timed: &[TimedFilter]) -> FilterColumn {
    let number = |(filter, cost): &TimedFilter| {
        let value = cost.seconds.median;
        let text = milliseconds(value);
        ((*filter).clone(), FilterNumber { value, text })
    };
    FilterColumn {
        name: "cost",
        unit: "ms",
        numbers: timed.iter().map(number).collect::<HashMap<_, _>>(),
    }
}

/// Lists the run's timed filters.
fn list_timed<'a>(table: &'a CaseTable, bench: &'a Bench) -> Vec<TimedFilter<'a>> {
    let width = table.run.render.width;
    let timed = table.filters.iter().filter_map(|filter| {
        let (_, case) = table.cases_of(filter).next()?;
        Some((filter, cost_of(bench, case, width)?))
    });
    timed.collect()
}

/// Finds the cost of a case's filter; none for references, and for filters that were not timed with
/// exactly these parameters. A bench of another width than the pictures' has its own values in
/// pixels.
fn cost_of<'a>(bench: &'a Bench, case: &Case, width: u32) -> Option<&'a CaseCost> {
    let ratio = f64::from(bench.width) / f64::from(width);
    let is_scaled = case.reference_width.is_some();
    bench.cases.iter().find(|cost| {
        (&cost.filter, &cost.preset, cost.reference_width)
            == (&case.filter, &case.preset, case.reference_width)
            && cost.parameters.keys().eq(case.parameters.keys())
            && (cost.parameters.values().zip(case.parameters.values())).all(|(cost, case)| {
                cost == case || is_scaled && are_equally_long(case, cost, ratio)
            })
    })
}

/// Returns whether a value in pixels equals another one for pictures `ratio` times as wide, up to
/// rounding of the smaller one.
fn are_equally_long(first: &Value, second: &Value, ratio: f64) -> bool {
    let number = |value: &Value| match value {
        Value::Integer(value) => Some(f64::from(*value)),
        Value::Real(value) => Some(*value),
        Value::Choice(_) => None,
    };
    number(first)
        .zip(number(second))
        .is_some_and(|(first, second)| (first * ratio - second).abs() <= ratio.max(1.0))
}

#[test]
fn values_in_pixels_belong_together_if_they_are_as_long_in_their_pictures() {
    // 20 pixels of 1920 are 3.3 of 320.
    let whole = |first, second, ratio| {
        are_equally_long(&Value::Integer(first), &Value::Integer(second), ratio)
    };
    assert!(whole(3, 20, 6.0) && whole(20, 3, 1.0 / 6.0));
    assert!(!whole(3, 40, 6.0) && !whole(8, 15, 1.0));
    assert!(are_equally_long(&Value::Real(0.25), &Value::Real(1.5), 6.0));
    let [a, b] = ["a", "b"].map(|name| Value::Choice(name.to_owned()));
    assert!(!are_equally_long(&a, &b, 1.0));
}
