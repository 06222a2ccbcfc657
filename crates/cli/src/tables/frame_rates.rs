//! Table of what filters score at each frame rate.

use metrics::Metric;
use suite::{Case, InputFormat};
use tracer::FrameRate;

use super::{abreast_text, legend_text, list_once};

/// Makes a row per frame rate and rule of the shutter, and a column per filter and per picture of doing nothing: the mean FLIP over the
/// scenes. Empty for a run of one rate.
pub fn frame_rates_text(cases: &[Case]) -> String {
    let rows = list_rows(cases);
    if rows.iter().all(|row| row.rate == rows[0].rate) {
        return String::new();
    }
    let columns: Vec<String> = cases.iter().filter_map(column).collect();
    let columns = list_once(columns.iter().map(String::as_str));
    let cell = |row: &Row, name: &str| mean_flip(cases, row, name);
    let mut text = "\n".to_owned();
    text += &abreast_text("frame rate", &columns, &rows, Row::title, cell);
    text += "\n";
    text += &legend_text(
        "Mean FLIP at each frame rate, against the truths of that rate. [identity] is doing nothing. Compare the filters of one row, \
         and each with the identity of its shutter.",
    );
    text
}

/// A row of the table.
#[derive(PartialEq)]
struct Row {
    /// None for the rate of the scenes' files.
    rate: Option<FrameRate>,
    /// Form in which filters get the frame: the full one, or that of another rule of the shutter.
    input: InputFormat,
}

impl Row {
    fn title(&self) -> String {
        let rate = self
            .rate
            .map_or("as written".to_owned(), |rate| rate.word());
        match self.input.change() {
            None => rate,
            Some(change) => format!("{rate} {change}"),
        }
    }
}

/// Lists rates and rules in the order of the cases. At the rate of the files every rule is the right one.
fn list_rows(cases: &[Case]) -> Vec<Row> {
    let mut rows = Vec::new();
    for case in cases {
        let row = Row {
            rate: case.rate,
            input: InputFormat {
                rule: case.input.rule,
                ..InputFormat::default()
            },
        };
        let is_shown = row.input == InputFormat::default() || row.rate.is_some();
        if is_shown && row.input == case.input && !rows.contains(&row) {
            rows.push(row);
        }
    }
    rows
}

/// Names the column of a case, without the form of its input; none of a reference other than doing nothing.
fn column(case: &Case) -> Option<String> {
    let name = case.name();
    match (case.is_reference, case.filter.as_str()) {
        (false, _) => {
            let form = case.input.change().map(|change| format!(" {change}"));
            let full = form.and_then(|form| name.strip_suffix(form.as_str()).map(str::to_owned));
            Some(full.unwrap_or(name))
        }
        (true, suite::IDENTITY) => Some(format!("[{name}] {}", case.alignment)),
        _ => None,
    }
}

/// Averages FLIP over the scenes of a row. Doing nothing follows no rule.
fn mean_flip(cases: &[Case], row: &Row, name: &str) -> String {
    let of_row =
        |case: &&Case| case.rate == row.rate && (case.input == row.input || case.is_reference);
    let own = (cases.iter().filter(of_row)).filter(|case| column(case).as_deref() == Some(name));
    let flips: Vec<f64> = own.filter_map(|case| case.estimate(Metric::FLIP)).collect();
    match flips.len() {
        0 => "n/a".to_owned(),
        count => Metric::FLIP.number(flips.iter().sum::<f64>() / count as f64),
    }
}
