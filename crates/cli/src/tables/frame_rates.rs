//! Table of what filters score at each frame rate.

use suite::{Case, Headline};
use tracer::FrameRate;

use super::columns::{legend_text, list_once, number_table};

/// Columns side by side, so that a row fits a terminal.
const COLUMNS_ABREAST: usize = 3;

/// Makes a row per frame rate and a column per filter and form of its input, and per picture of doing nothing: the mean FLIP over the
/// scenes. Empty for a run of one rate.
pub fn frame_rates_text(cases: &[Case]) -> String {
    let mut rates: Vec<Option<FrameRate>> = Vec::new();
    for case in cases {
        if !rates.contains(&case.rate) {
            rates.push(case.rate);
        }
    }
    if rates.len() < 2 {
        return String::new();
    }
    let columns: Vec<String> = cases.iter().filter_map(column).collect();
    let mut text = String::from("\n");
    for columns in list_once(columns.iter().map(String::as_str)).chunks(COLUMNS_ABREAST) {
        let titles: Vec<&str> = std::iter::once("frame rate")
            .chain(columns.iter().copied())
            .collect();
        let mut table = number_table(&titles);
        for rate in &rates {
            let word = rate.map_or("as written".to_owned(), |rate| rate.word());
            let means = columns.iter().map(|name| mean_flip(cases, *rate, name));
            table.push(std::iter::once(word).chain(means).collect());
        }
        text += &table.text();
    }
    text += "\n";
    text += &legend_text(
        "Mean FLIP at each frame rate, against the truths of that rate. [identity] is doing nothing. Compare the filters of one row, \
         and filters with the identity of their shutter.",
    );
    text
}

/// Names the column of a case; none of a reference other than doing nothing.
fn column(case: &Case) -> Option<String> {
    match (case.is_reference, case.filter.as_str()) {
        (false, _) => Some(case.name()),
        (true, suite::IDENTITY) => Some(format!("[{}] {}", case.name(), case.alignment)),
        _ => None,
    }
}

fn mean_flip(cases: &[Case], rate: Option<FrameRate>, name: &str) -> String {
    let own = cases.iter().filter(|case| case.rate == rate);
    let own = own.filter(|case| column(case).as_deref() == Some(name));
    let flips: Vec<f64> = own
        .filter_map(|case| Headline::FLIP.estimate(case))
        .collect();
    match flips.len() {
        0 => "n/a".to_owned(),
        count => Headline::FLIP.number(flips.iter().sum::<f64>() / count as f64),
    }
}
