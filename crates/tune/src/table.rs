//! Tables of a finished tuning, of two presets, and of a sensitivity study.

use measure::MIN_SCENES;
use report::numbers::percent;
use terminal::output::{count_text, heading, push_wrapped};
use terminal::table::{Table, cell};

use crate::advice::Advice;
use crate::comparison::{Difference, PairedComparison, Preference};
use crate::loss::LEAST_BLEED;
use crate::sensitivity::{ParameterSensitivity, Sensitivity};
use crate::sobol::SobolIndices;
use crate::trial::Trial;
use crate::tuning::Tuning;

/// Upper limit on rows of the front; `tune.json` has all.
const ROWS: usize = 12;
/// Column where their values begin.
const VALUES: usize = 34;

/// Makes the tables: start, front, choice, folds and held-out scenes.
pub fn tuning_table(tuning: &Tuning) -> String {
    let journal = &tuning.journal;
    let mut text = heading(&format!(
        "{}:{}, {} trials on {} scenes: {} dropped early, {} failed",
        journal.filter,
        journal.start,
        tuning.trials,
        journal.scenes.len(),
        tuning.dropped,
        tuning.failed.len(),
    ));
    text += "\n\n";
    text += &heading("trial    error    bleed     cost  values that differ from the start");
    text += "\n";
    let mut rows = vec![&tuning.start];
    let front = tuning.front.iter().take(ROWS);
    rows.extend(front.filter(|trial| trial.trial != 0));
    if !rows.iter().any(|row| row.trial == tuning.chosen.trial) {
        rows.push(&tuning.chosen);
    }
    for trial in rows {
        text += &trial_row(trial, &tuning.start, tuning.chosen.trial);
    }
    text += "bleed: bleed_lateral of the worst scene, in pixels\n";
    if tuning.front.len() > ROWS {
        text += &format!("and {} more in tune.json\n", tuning.front.len() - ROWS);
    }
    text += "\n";
    push_wrapped(&mut text, 0, &choice_text(tuning));
    if !tuning.folds.is_empty() {
        text += "\n";
        text += &heading("family left out  scenes  trial  on the others  on the family    gap");
        text += "\n";
    }
    for fold in &tuning.folds {
        text += &format!(
            "{:15} {:7} {:6} {:14.3} {:14.3} {:6.3}\n",
            fold.family, fold.scenes, fold.trial, fold.others, fold.held_out, fold.gap
        );
    }
    if let Some(last) = tuning.held_out.last() {
        let times = match tuning.held_out.len() {
            1 => "once".to_owned(),
            times => format!("{times} times"),
        };
        let [width, height, samples] = last.render;
        text += &format!(
            "\nheld-out scenes, evaluated {times} at {width}x{height}, {samples} samples per pixel:\n{}",
            paired_table(&last.paired, ["start", "chosen"])
        );
    }
    for (trial, reason) in &tuning.failed {
        push_wrapped(&mut text, 0, &format!("failed: trial {trial}: {reason}"));
    }
    text
}

/// Describes the choice and its distance from the best.
fn choice_text(tuning: &Tuning) -> String {
    let choice = &tuning.choice;
    let title = match tuning.advice() {
        Advice::Take => "chosen",
        _ => "candidate",
    };
    let error = percent(tuning.chosen.error.expect("the choice is done"));
    let reset = match choice.reset.as_slice() {
        [] => String::new(),
        names => format!(" with {} as in the start", names.join(", ")),
    };
    let distance = if choice.trial == choice.best && choice.reset.is_empty() {
        "it is the best, and the scenes prefer it to all that is nearer to the start".to_owned()
    } else {
        format!(
            "nearer to the start than the best, trial {}, with a difference of {} and a standard error of {:.1} %",
            choice.best,
            percent(choice.loss.mean),
            100.0 * choice.loss.standard_error
        )
    };
    format!(
        "{title}: trial {}{reset}, {error}; {distance}",
        choice.trial
    )
}

/// Recommends the choice and names its files, or says why there is no preset.
pub fn advice_text(tuning: &Tuning) -> String {
    let trial = tuning.choice.trial;
    let reason = match tuning.advice() {
        Advice::Take => {
            return "the choice: params.json and preset.toml next to tune.json\n".to_owned();
        }
        Advice::NoneIsBetter => "no trial beats it by more than the scenes can show".to_owned(),
        Advice::CannotTell(difference) if difference.scenes < MIN_SCENES => format!(
            "{} cannot separate trial {trial} from it, and {MIN_SCENES} or more may",
            count_text(difference.scenes, "scene", "scenes")
        ),
        Advice::CannotTell(difference) => format!(
            "the scenes cannot separate trial {trial} from it ({})",
            difference.text(percent)
        ),
        Advice::StartIsBetter(flip) => format!(
            "on the {} held-out scenes trial {trial} is worse ({})",
            flip.scenes,
            percent(flip.mean)
        ),
    };
    let mut text = String::new();
    let sentence = format!("keep the start, no preset.toml is written: {reason}");
    push_wrapped(&mut text, 0, &sentence);
    text
}

fn trial_row(trial: &Trial, start: &Trial, chosen: usize) -> String {
    let changed = (trial.values.iter())
        .filter(|(name, value)| start.values[*name] != **value)
        .map(|(name, value)| format!("{name}={value}"));
    let changed = match trial.trial {
        0 => "the start".to_owned(),
        _ => changed.collect::<Vec<_>>().join(" "),
    };
    let mut numbers = format!("{:4}", trial.trial);
    numbers += if trial.trial == chosen { "*" } else { " " };
    for value in [trial.error, trial.bleed, trial.cost] {
        let text = value.map_or("-".to_owned(), |value| format!("{value:.3}"));
        numbers += &format!(" {text:>8}");
    }
    let mut values = String::new();
    // Every line of values begins where the numbers end.
    push_wrapped(&mut values, VALUES, &changed);
    numbers + values.get(VALUES - 2..).unwrap_or_default()
}

/// Compares two candidates scene by scene.
pub fn paired_table(paired: &PairedComparison, names: [&str; 2]) -> String {
    let [first, second] = names;
    let titles = [
        &format!("FLIP {first}"),
        second,
        &format!("bleed {first}"),
        second,
    ];
    let mut table = Table::new("scene", titles);
    for (scene, both) in &paired.scenes {
        let flips = both.map(|scores| format!("{:.4}", scores.flip));
        let bleeds = both.map(|scores| cell(scores.bleed, |bleed| format!("{bleed:.3}")));
        table.push(scene, flips.into_iter().chain(bleeds));
    }
    let mut text = table.text();
    let mut push = |what: &str, numbers: String, verdict: &str| {
        let line = format!("{what} of {second} against {first}: {numbers}: {verdict}");
        push_wrapped(&mut text, 0, &line);
    };
    let verdict = |difference: &Difference| match difference.verdict {
        Preference::First => format!("{first} is better"),
        Preference::Second => format!("{second} is better"),
        Preference::Undecided => "undecided".to_owned(),
    };
    push("FLIP", paired.flip.text(percent), &verdict(&paired.flip));
    if let Some(bleed) = &paired.bleed {
        let mut verdict = verdict(bleed);
        if bleed.verdict == Preference::Undecided && bleed.is_no_worse(LEAST_BLEED) {
            verdict += ", and no worse";
        }
        let numbers = bleed.text(|bleed| format!("{bleed:+.3} px"));
        push("lateral bleed", numbers, &verdict);
    }
    text
}

/// Makes the table of parameters, most important first.
pub fn sensitivity_table(sensitivity: &Sensitivity) -> String {
    let mut rows: Vec<(&String, &ParameterSensitivity)> = sensitivity.parameters.iter().collect();
    rows.sort_by(|(_, a), (_, b)| b.indices.total.value.total_cmp(&a.indices.total.value));
    let mut table = Table::new(
        "parameter",
        ["first order", "total", "95 % CI", "constant?"],
    );
    for (name, parameter) in rows {
        let SobolIndices { first, total } = parameter.indices;
        let constant = if parameter.constant { "yes" } else { "no" };
        let cells = [
            format!("{:.3}", first.value),
            format!("{:.3}", total.value),
            format!("{:.3} to {:.3}", total.low, total.high),
            constant.to_owned(),
        ];
        table.push(name, cells);
    }
    table.text()
        + &format!(
            "{} candidates, {} failed\n",
            sensitivity.candidates, sensitivity.failed
        )
}
