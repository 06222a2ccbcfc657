//! Table of what filters score at each frame rate.

use metrics::Metric;
use suite::{Case, InputFormat};
use tracer::FrameRate;

use super::{abreast_text, list_once, mean_text};

/// Makes a row per frame rate and rule of the shutter, and a column per filter and per picture of doing nothing: the mean FLIP over the
/// scenes. Empty for a run of one rate.
pub fn frame_rates_text(cases: &[Case]) -> String {
    let rows = list_once(cases.iter().filter_map(Row::of));
    if rows.iter().all(|row| row.rate == rows[0].rate) {
        return String::new();
    }
    let columns = list_once(cases.iter().filter_map(column));
    let flip = |row: &Row, name: &String| {
        let of_row = cases.iter().filter(|case| row.holds(case));
        let own = of_row.filter(|case| column(case).as_ref() == Some(name));
        let flips = own.filter_map(|case| case.estimate(Metric::FLIP));
        mean_text(flips, |mean| Metric::FLIP.number(mean))
    };
    let legend = "Mean FLIP at each frame rate, against the truths of that rate. [identity] is doing nothing. Compare the filters of one \
                  row, and each with the identity of its shutter.";
    abreast_text("frame rate", &columns, &rows, Row::title, flip, legend)
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
    /// Makes the row of a case; none of another form than those of the table. At the rate of the files every rule is the right one.
    fn of(case: &Case) -> Option<Self> {
        let input = InputFormat {
            rule: case.input.rule,
            ..InputFormat::default()
        };
        let is_shown = input == InputFormat::default() || case.rate.is_some();
        (is_shown && input == case.input).then_some(Self {
            rate: case.rate,
            input,
        })
    }

    /// Tells whether a case is in the row. Doing nothing follows no rule.
    fn holds(&self, case: &Case) -> bool {
        case.rate == self.rate && (case.input == self.input || case.is_reference)
    }

    fn title(&self) -> String {
        let rate = self.rate.map(|rate| rate.word());
        let rate = rate.unwrap_or("as written".to_owned());
        let change = self.input.change().map(|change| format!(" {change}"));
        rate + &change.unwrap_or_default()
    }
}

/// Names the column of a case, without the form of its input; none of a reference other than doing nothing.
fn column(case: &Case) -> Option<String> {
    let name = case.name();
    match (case.is_reference, case.filter.as_str()) {
        (false, _) => {
            let form = case.input.change().map(|change| format!(" {change}"));
            let full = name.strip_suffix(form.as_deref().unwrap_or_default());
            Some(full.unwrap_or(&name).to_owned())
        }
        (true, suite::IDENTITY) => Some(format!("[{name}] {}", case.alignment)),
        _ => None,
    }
}
