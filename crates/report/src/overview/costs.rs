//! Section on the cost of filters, from the bench.json beside the run, where there is one.

use std::path::Path;

use filters::{Clock, Value};
use maud::{Markup, html};
use metrics::Metric;

use super::pareto::{Point, pareto_chart};
use crate::case_table::CaseTable;
use crate::filter_id::mean;
use suite::FilterId;
use suite::read_text;
use suite::{BASELINE, BENCH_FORMAT, CaseCost, GROWTH_FROM, REACHES, Spread};
use suite::{Bench, Error, SIDES};

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
pub fn cost_of<'a>(
    table: &CaseTable,
    bench: Option<&'a Bench>,
    filter: &FilterId,
) -> Option<&'a CaseCost> {
    let (_, case) = table.cases_of(filter).next()?;
    let mut costs = bench?.cases.iter();
    let ratio = f64::from(bench?.width) / f64::from(table.run.render.width);
    costs.find(|cost| {
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

/// Writes `1.23`, in milliseconds; `-` where nothing was timed.
pub fn cost_text(cost: Option<&CaseCost>) -> String {
    cost.map_or("-".to_owned(), |cost| milliseconds(cost.seconds.median))
}

/// Shows quality against time, passes, and cost against reach.
pub fn costs(table: &CaseTable, bench: Option<&Bench>) -> Markup {
    html! {
        section.costs {
            h2 { "Costs" }
            @match bench {
                None => p {
                    "Nothing was timed beside this run. " code { "shuttertruth bench --out FOLDER" }
                    ", with the run's folder, times its filters; then report again."
                },
                Some(bench) => {
                    p.note { (provenance(bench)) }
                    (pareto_chart(&points(table, bench), &references(table)))
                    (passes(table, bench))
                    (reaches(bench))
                }
            }
        }
    }
}

fn provenance(bench: &Bench) -> String {
    let clock = match bench.clock {
        Clock::Timestamps => "by the GPU's own clock",
        Clock::WallClock => "by the wall clock around each pass: the adapter has no timestamps",
    };
    format!(
        "Timed on {} ({}, {}, driver {}) at {}x{}, on panels that move {} pixels: median of {} rounds {clock}. Quality is that of \
         this run's pictures.",
        bench.adapter.name,
        bench.adapter.kind,
        bench.adapter.backend,
        bench.adapter.driver,
        bench.width,
        bench.height,
        bench.speed,
        bench.rounds
    )
}

/// Measures FLIP and time of every filter that was timed. Filters of all shutters stand in one picture, so FLIP is against one
/// shutter for all.
fn points(table: &CaseTable, bench: &Bench) -> Vec<Point> {
    let timed = table.filters.iter().filter_map(|filter| {
        let cost = cost_of(table, Some(bench), filter)?;
        Some(Point {
            title: filter.to_string(),
            milliseconds: 1e3 * cost.seconds.median,
            quartiles: [cost.seconds.lower_quartile, cost.seconds.upper_quartile]
                .map(|seconds| 1e3 * seconds),
            error: mean_error(table, filter)?,
        })
    });
    timed.collect()
}

/// Measures the references' errors, which no time belongs to.
fn references(table: &CaseTable) -> Vec<(String, f64)> {
    let all = table.filters.iter();
    all.filter(|filter| filter.is_reference)
        .filter_map(|own| Some((own.to_string(), mean_error(table, own)?)))
        .collect()
}

/// Averages over the scenes that have an error.
fn mean_error(table: &CaseTable, filter: &FilterId) -> Option<f64> {
    let cases = table.cases_of(filter);
    mean(cases.filter_map(|(_, case)| case.estimate(Metric::CommonFlip)))
}

/// Lists the run's filters that were timed.
fn find_timed<'a>(table: &CaseTable, bench: &'a Bench) -> Vec<(String, &'a CaseCost)> {
    let timed = table.filters.iter();
    timed
        .filter_map(|filter| Some((filter.to_string(), cost_of(table, Some(bench), filter)?)))
        .collect()
}

fn passes(table: &CaseTable, bench: &Bench) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Time of every pass" {
            table.passes {
                caption { "Time of every pass; baseline: " (BASELINE) }
                thead {
                    tr {
                        th scope="col" { "filter / pass" }
                        th scope="col" { "ms" }
                        th scope="col" { "quartiles" }
                        th scope="col" { "x baseline" }
                        th scope="col" { "bytes per pixel" }
                    }
                }
                @for (title, cost) in find_timed(table, bench) {
                    tbody {
                        tr.group {
                            th scope="row" { (title) }
                            (spread(&cost.seconds))
                            td { (format!("{:.2}", cost.ratio.median)) }
                            td { (format!("{:.0}", cost.bytes_per_pixel)) }
                        }
                        @for pass in &cost.passes {
                            tr.pass {
                                th scope="row" {
                                    (pass.entry) @if pass.iterations > 1 { " x " (pass.iterations) }
                                }
                                (spread(&pass.seconds))
                                td {}
                                td { (format!("{:.0}", pass.bytes_per_pixel)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn reaches(bench: &Bench) -> Markup {
    let last = REACHES[REACHES.len() - 1];
    html! {
        div.scroll tabindex="0" role="region" aria-label="Cost against reach" {
            table {
                caption {
                    "Cost against reach: milliseconds for motion of 8 to 256 pixels, with the filter set to cover it"
                }
                thead {
                    tr {
                        th scope="col" { "filter" }
                        @for pixels in REACHES { th scope="col" { (pixels) " px" } }
                        th scope="col" { (last) " / " (GROWTH_FROM) }
                    }
                }
                tbody {
                    @for cost in &bench.reaches {
                        tr {
                            th scope="row" { (cost.filter) ":" (cost.preset) }
                            @for point in &cost.points {
                                td { (point.seconds.map_or("-".to_owned(), |own| milliseconds(own.median))) }
                            }
                            td { (cost.growth.map_or("-".to_owned(), |own| format!("{:.2}", own.median))) }
                        }
                    }
                }
            }
        }
    }
}

fn spread(seconds: &Spread) -> Markup {
    html! {
        td { (milliseconds(seconds.median)) }
        td { (milliseconds(seconds.lower_quartile)) "–" (milliseconds(seconds.upper_quartile)) }
    }
}

fn milliseconds(seconds: f64) -> String {
    let digits = if seconds < 0.01 { 2 } else { 1 };
    format!("{:.digits$}", 1e3 * seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_pixels_belong_together_if_they_are_as_long_in_their_pictures() {
        // 20 pixels of 1920 are 3.3 of 320.
        assert!(is_scaled(&Value::Integer(3), &Value::Integer(20), 6.0));
        assert!(is_scaled(
            &Value::Integer(20),
            &Value::Integer(3),
            1.0 / 6.0
        ));
        assert!(is_scaled(&Value::Real(0.25), &Value::Real(1.5), 6.0));
        assert!(!is_scaled(&Value::Integer(3), &Value::Integer(40), 6.0));
        assert!(!is_scaled(&Value::Integer(8), &Value::Integer(15), 1.0));
        let [a, b] = ["a", "b"].map(|name| Value::Choice(name.to_owned()));
        assert!(!is_scaled(&a, &b, 1.0));
    }
}
