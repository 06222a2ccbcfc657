//! Tables of filters side by side: scores at each frame rate and on each engine's frames, and the
//! cost of each input form.

use judge::{RankedFilter, list_summarized};
use measure::{Case, FilterId, InputFormat, ReferencePicture};
use metrics::Metric;
use scene::{FrameRate, SceneId};
use terminal::output::Text;

use super::{Table, bracket_name, cell, legend_text, list_once, mean_text};

/// Columns side by side in a table with many.
const ABREAST: usize = 3;

/// Makes tables with a few columns each, so that a row fits a terminal, and the note below them.
fn abreast_text<R>(
    title: &str,
    columns: &[String],
    rows: &[R],
    name: impl Fn(&R) -> String,
    cell: impl Fn(&R, &String) -> String,
    legend: &str,
) -> Text {
    let tables = columns.chunks(ABREAST).map(|columns| {
        let mut table = Table::new(title, columns);
        for row in rows {
            table.push(name(row), columns.iter().map(|column| cell(row, column)));
        }
        table.text()
    });
    let tables: Text = tables.sum();
    Text::from("\n") + tables + "\n" + legend_text(legend)
}

/// Makes a row per input form and a column per filter: the change of mean FLIP against the full
/// form. Empty for a run with no other form. Shutter rules, which change nothing at the scene
/// files' frame rate, are in the table of rates.
pub fn input_forms_text(cases: &[Case]) -> Text {
    let cases = list_summarized(cases);
    let is_shown = |case: &&&Case| case.rate.is_some() || case.input.rule == Default::default();
    let shown = cases.iter().filter(is_shown);
    let changes = list_once(shown.filter_map(|case| case.input.change()));
    if changes.is_empty() {
        return Text::default();
    }
    let is_full = |case: &&&Case| !case.is_reference && case.input == InputFormat::default();
    let full: Vec<&&Case> = cases.iter().filter(is_full).collect();
    let names = list_once(full.iter().map(|case| case.name()));
    // Over the scenes that have both scores.
    let cost = |change: &String, name: &String| {
        let changed = format!("{name} {change}");
        let measured = full.iter().filter(|case| case.name() == *name);
        let costs = measured.filter_map(|case| {
            let mut others = cases.iter().filter(|other| other.scene == case.scene);
            let other = others.find(|other| other.name() == changed)?;
            Some(other.estimate(Metric::FLIP)? - case.estimate(Metric::FLIP)?)
        });
        mean_text(costs, |cost| format!("{cost:+.3}"))
    };
    let legend = "Change of the mean FLIP against the full form of the input; + is worse.";
    abreast_text(
        "form of the input",
        &names,
        &changes,
        String::clone,
        cost,
        legend,
    )
}

/// Makes a row per frame rate and shutter rule, and a column per filter and per unblurred picture:
/// mean FLIP over the scenes. Empty for a run of one rate.
pub fn frame_rates_text(cases: &[Case]) -> Text {
    let rows = list_once(cases.iter().filter_map(Row::of));
    if rows.iter().all(|row| row.rate == rows[0].rate) {
        return Text::default();
    }
    let columns = list_once(cases.iter().filter_map(column));
    let flip = |row: &Row, name: &String| {
        let of_row = cases.iter().filter(|case| row.holds(case));
        let measured = of_row.filter(|case| column(case).as_ref() == Some(name));
        let flips = measured.filter_map(|case| case.estimate(Metric::FLIP));
        mean_text(flips, |mean| Metric::FLIP.number(mean))
    };
    let legend = "Mean FLIP at each frame rate, against the truths of that rate. [identity] is doing nothing. Compare the filters of one \
                  row, and each with the identity of its shutter.";
    abreast_text("frame rate", &columns, &rows, Row::title, flip, legend)
}

/// Title of the column of our own frames.
const OURS: &str = "ours";

/// Makes a row per ranked filter, best on the engines' frames first, and a column for our frames
/// and for each engine's: mean FLIP over the scenes that the run has in both. Empty if there is
/// none.
pub fn twins_text(cases: &[Case], ranked: &[Vec<RankedFilter>]) -> Text {
    let full: Vec<&Case> = (list_summarized(cases).into_iter())
        .filter(|case| case.input == InputFormat::default())
        .collect();
    let is_ours = |scene: &SceneId| {
        let mut ours = full.iter().filter(|case| case.drawn.is_none());
        ours.any(|case| case.scene == *scene)
    };
    let twin = |case: &Case| {
        case.drawn
            .as_ref()?
            .scene
            .clone()
            .filter(|scene| is_ours(scene))
    };
    let drawn = || full.iter().filter(|case| twin(case).is_some());
    let scenes = list_once(drawn().filter_map(|case| twin(case)));
    let engines = list_once(drawn().filter_map(|case| case.scene.variant.clone()));
    let is_row = |case: &Case| {
        if case.is_reference {
            case.reference() == Some(ReferencePicture::Identity)
        } else {
            (ranked.iter().flatten()).any(|filter| filter.name == case.name())
        }
    };
    let mut rows = list_once((drawn().filter(|case| is_row(case))).map(|case| case.filter_id()));
    if rows.is_empty() {
        return Text::default();
    }
    let mean = |row: &FilterId, column: &String| {
        let is_in = |case: &&&Case| {
            if column == OURS {
                case.drawn.is_none() && scenes.contains(&case.scene)
            } else {
                twin(case).is_some() && case.scene.variant.as_ref() == Some(column)
            }
        };
        mean_flip(full.iter().filter(is_in).copied(), row)
    };
    let best = |row: &FilterId| {
        let means = engines.iter().filter_map(|engine| mean(row, engine));
        means.fold(f64::INFINITY, f64::min)
    };
    rows.sort_by(|a, b| best(a).total_cmp(&best(b)));
    let columns = [vec![OURS.to_owned()], engines.clone()].concat();
    let count = scenes.len();
    let legend = format!(
        "Mean FLIP over {count} scene{}, on frames traced here and on the engine's own. Compare the filters of one column; an \
         engine's own blur is in its column only.",
        if count == 1 { "" } else { "s" }
    );
    abreast_text(
        "whose frames",
        &columns,
        &rows,
        |row| bracket_name(&row.name, row.is_reference),
        |row, column| cell(mean(row, column), |mean| Metric::FLIP.number(mean)),
        &legend,
    )
}

/// Means the FLIP of a filter over some cases; none if no case is of it.
fn mean_flip<'a>(cases: impl Iterator<Item = &'a Case>, filter: &FilterId) -> Option<f64> {
    let cases = cases.filter(|case| case.filter_id() == *filter);
    let flips: Vec<f64> = cases
        .filter_map(|case| case.estimate(Metric::FLIP))
        .collect();
    (!flips.is_empty()).then(|| flips.iter().sum::<f64>() / flips.len() as f64)
}

/// A row of the table.
#[derive(PartialEq)]
struct Row {
    /// None for the scene files' rate.
    rate: Option<FrameRate>,
    /// Form of the frame that filters get: the full one, or another shutter rule's.
    input: InputFormat,
}

impl Row {
    /// Makes a case's row; none for input forms that the table does not show. At the files' rate
    /// every rule is right.
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

    /// Returns whether a case is in the row. Doing nothing follows no rule.
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

/// Names a case's column, without its input form; none for a reference other than doing nothing.
fn column(case: &Case) -> Option<String> {
    let name = case.name();
    match case.reference() {
        Some(ReferencePicture::Identity) => Some(format!("[{name}] {}", case.alignment)),
        _ if case.is_reference => None,
        _ => {
            let form = case.input.change().map(|change| format!(" {change}"));
            let full = name.strip_suffix(form.as_deref().unwrap_or_default());
            Some(full.unwrap_or(&name).to_owned())
        }
    }
}
