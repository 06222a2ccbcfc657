//! The bench.json beside a run, and the costs in it.

use std::path::Path;

use filters::Value;
use store::read_text;
use suite::{BENCH_FORMAT, Bench, CaseCost, Error, FilterId, REACHES, SIDES};

use crate::case_table::CaseTable;

/// Name of the file that `shuttertruth bench` writes.
const BENCH_FILE: &str = "bench.json";

/// Reads the bench that was written into the folder of a run; none where there is no such file.
pub fn read_bench(folder: &Path) -> Result<Option<Bench>, Error> {
    let path = folder.join(BENCH_FILE);
    if !path.exists() {
        return Ok(None);
    }
    let text = read_text(&path)?;
    let refuse = |reason: String| {
        Error::Usage(format!(
            "{}: {reason}; `shuttertruth bench` writes one; delete it to have a report without costs",
            path.display()
        ))
    };
    let bench: Bench = serde_json::from_str(&text)
        .map_err(|error| refuse(format!("no bench of this program: {error}")))?;
    if bench.format != BENCH_FORMAT {
        return Err(refuse(format!(
            "has format {}; allowed: {BENCH_FORMAT}",
            bench.format
        )));
    }
    check_times(&bench).map_err(refuse)?;
    Ok(Some(bench))
}

/// Refuses times that no clock takes, sizes that no picture has, and reaches that were not timed: charts take logarithms.
fn check_times(bench: &Bench) -> Result<(), String> {
    let sides = [bench.width, bench.height];
    if !sides.iter().all(|side| SIDES.contains(side)) {
        return Err(format!(
            "has pictures of {}x{} pixels; allowed: {} to {} columns and rows",
            bench.width,
            bench.height,
            SIDES.start(),
            SIDES.end()
        ));
    }
    let of_cases = (bench.cases.iter()).flat_map(|case| {
        let passes = case.passes.iter().map(|pass| &pass.seconds);
        std::iter::once(&case.seconds).chain(passes)
    });
    let points = (bench.reaches.iter()).flat_map(|reach| &reach.points);
    let of_reaches = points.filter_map(|point| point.seconds.as_ref());
    let times = of_cases.chain(of_reaches);
    let wrong = times
        .flat_map(|own| [own.median, own.lower_quartile, own.upper_quartile])
        .find(|seconds| !(0.0..=LONGEST).contains(seconds));
    if let Some(seconds) = wrong {
        return Err(format!(
            "holds a time of {seconds} s; allowed: 0 to {LONGEST}"
        ));
    }
    for reach in &bench.reaches {
        let pixels: Vec<u32> = reach.points.iter().map(|point| point.pixels).collect();
        if pixels != REACHES {
            return Err(format!(
                "{}:{} was timed at the reaches {pixels:?}; allowed: {REACHES:?}",
                reach.filter, reach.preset
            ));
        }
    }
    Ok(())
}

/// Seconds of anything that a bench times: a day.
const LONGEST: f64 = 86_400.0;

/// Finds the cost of a filter; none for references, and for filters that were not timed with these very parameters. A bench of
/// another width has its own values in pixels.
pub fn cost_of<'a>(table: &'a CaseTable, filter: &FilterId) -> Option<&'a CaseCost> {
    let (_, case) = table.cases_of(filter).next()?;
    let bench = table.bench.as_ref()?;
    let ratio = f64::from(bench.width) / f64::from(table.run.render.width);
    bench.cases.iter().find(|cost| {
        let scaled = case.reference_width.is_some();
        (&cost.filter, &cost.preset, cost.reference_width)
            == (&case.filter, &case.preset, case.reference_width)
            && cost.parameters.len() == case.parameters.len()
            && (cost.parameters.iter().zip(&case.parameters)).all(|(cost, case)| {
                cost == case || scaled && cost.0 == case.0 && is_scaled(case.1, cost.1, ratio)
            })
    })
}

/// Tells whether a value in pixels is another one for pictures `ratio` times as wide, but for what rounding may do to the
/// smaller of both.
fn is_scaled(first: &Value, second: &Value, ratio: f64) -> bool {
    let number = |value: &Value| match value {
        Value::Integer(value) => Some(f64::from(*value)),
        Value::Real(value) => Some(*value),
        Value::Choice(_) => None,
    };
    match (number(first), number(second)) {
        (Some(first), Some(second)) => (first * ratio - second).abs() <= ratio.max(1.0),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_pixels_belong_together_if_they_are_as_long_in_their_pictures() {
        // 20 pixels of 1920 are 3.3 of 320.
        let whole = |first, second, ratio| {
            is_scaled(&Value::Integer(first), &Value::Integer(second), ratio)
        };
        assert!(whole(3, 20, 6.0) && whole(20, 3, 1.0 / 6.0));
        assert!(!whole(3, 40, 6.0) && !whole(8, 15, 1.0));
        assert!(is_scaled(&Value::Real(0.25), &Value::Real(1.5), 6.0));
        let [a, b] = ["a", "b"].map(|name| Value::Choice(name.to_owned()));
        assert!(!is_scaled(&a, &b, 1.0));
    }
}
