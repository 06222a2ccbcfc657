//! A run's bench.json, and the costs in it.

use std::path::Path;

use bench::{Bench, CaseCost, Spread};
use filters::Value;
use maud::{Markup, html};
use measure::{Error, FilterId};

use crate::case_table::CaseTable;
use crate::numbers::three_digits;

/// Name of the file that `shuttertruth bench` writes.
const BENCH_FILE: &str = "bench.json";

/// Reads the bench in a run's folder; none if there is no such file.
pub fn read_bench(folder: &Path) -> Result<Option<Bench>, Error> {
    let path = folder.join(BENCH_FILE);
    path.exists().then(|| Bench::read(&path)).transpose()
}

/// Formats a time in milliseconds: `1.23`.
pub fn milliseconds(seconds: f64) -> String {
    three_digits(1e3 * seconds)
}

/// Writes the cells of a time: median and quartiles, in milliseconds.
pub fn spread(seconds: &Spread) -> Markup {
    html! {
        td { (milliseconds(seconds.median)) }
        td { (milliseconds(seconds.lower_quartile)) "–" (milliseconds(seconds.upper_quartile)) }
    }
}

/// Finds the cost of a filter; none for references, and for filters that were not timed with
/// exactly these parameters. A bench of another width has its own values in pixels.
pub fn cost_of<'a>(table: &'a CaseTable, filter: &FilterId) -> Option<&'a CaseCost> {
    let (_, case) = table.cases_of(filter).next()?;
    let bench = table.bench.as_ref()?;
    let ratio = f64::from(bench.width) / f64::from(table.run.render.width);
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
