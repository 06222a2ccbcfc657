//! Tables of a finished tuning, and of two presets.

use suite::MIN_SCENES;
use tune::{Advice, Difference, LEAST_BLEED, PairedComparison, Preference, Trial, Tuning};

use super::Table;
use crate::output::{count_text, heading, push_wrapped};

/// Upper limit on rows of the front; `tune.json` has all.
const ROWS: usize = 12;
/// Column at which their values begin.
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
    rows.extend(tuning.front.iter().take(ROWS));
    if !rows.iter().any(|row| row.trial == tuning.chosen.trial) {
        rows.push(&tuning.chosen);
    }
    for (index, trial) in rows.iter().enumerate() {
        if index == 0 || trial.trial != 0 {
            text += &trial_row(trial, &tuning.start, tuning.chosen.trial);
        }
    }
    text += "bleed: bleed_lateral of the worst scene, in pixels\n";
    if tuning.front.len() > ROWS {
        text += &format!("and {} more in tune.json\n", tuning.front.len() - ROWS);
    }
    let chosen = format!(
        "{}: trial {}, {}; the best is trial {}, and {} lies within its standard error of {:.3}",
        match tuning.advice() {
            Advice::Take => "chosen",
            _ => "candidate",
        },
        tuning.choice.trial,
        percent(tuning.chosen.error.expect("the choice is done")),
        tuning.choice.best,
        match tuning.choice.trial == tuning.choice.best {
            true => "nothing nearer to the start",
            false => "this one, nearer to the start,",
        },
        tuning.choice.standard_error,
    );
    text += "\n";
    push_wrapped(&mut text, 0, &chosen);
    if !tuning.folds.is_empty() {
        text += "\n";
        text += &heading("family left out  scenes  trial  on the others  on the family    gap");
        text += "\n";
        for fold in &tuning.folds {
            text += &format!(
                "{:15} {:7} {:6} {:14.3} {:14.3} {:6.3}\n",
                fold.family, fold.scenes, fold.trial, fold.others, fold.held_out, fold.gap
            );
        }
    }
    if let Some(last) = tuning.held_out.last() {
        text += &format!(
            "\nheld-out scenes, evaluated {} at {}x{}, {} samples per pixel:\n",
            match tuning.held_out.len() {
                1 => "once".to_owned(),
                times => format!("{times} times"),
            },
            last.render[0],
            last.render[1],
            last.render[2]
        );
        text += &paired_table(&last.paired, ["start", "chosen"]);
    }
    for (trial, reason) in &tuning.failed {
        push_wrapped(&mut text, 0, &format!("failed: trial {trial}: {reason}"));
    }
    text
}

/// Advises to take the choice, which lies in files beside tune.json, or says why there is no preset of it.
pub fn advice_text(tuning: &Tuning) -> String {
    let trial = tuning.choice.trial;
    let reason = match tuning.advice() {
        Advice::Take => {
            return "the choice: params.json and preset.toml beside tune.json\n".to_owned();
        }
        Advice::NoneIsBetter => "no trial beats it by more than the scenes can tell".to_owned(),
        Advice::CannotTell(own) if own.scenes < MIN_SCENES => format!(
            "{} cannot tell trial {trial} from it, and {MIN_SCENES} or more may",
            count_text(own.scenes, "scene", "scenes")
        ),
        Advice::CannotTell(own) => format!(
            "the scenes cannot tell trial {trial} from it ({})",
            own.text(percent)
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
    let changed: Vec<String> = (trial.values.iter())
        .filter(|(name, value)| start.values[*name] != **value)
        .map(|(name, value)| format!("{name}={value}"))
        .collect();
    let number = |value: Option<f64>| match value {
        Some(value) => format!("{value:8.3}"),
        None => format!("{:>8}", "-"),
    };
    let changed = match trial.trial {
        0 => "the start".to_owned(),
        _ => changed.join(" "),
    };
    let numbers = format!(
        "{:4}{} {} {} {}",
        trial.trial,
        if trial.trial == chosen { "*" } else { " " },
        number(trial.error),
        number(trial.bleed),
        number(trial.cost),
    );
    let mut values = String::new();
    // As far to the right as the numbers are wide.
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
    let bleed = |bleed: Option<f64>| bleed.map_or("n/a".to_owned(), |bleed| format!("{bleed:.3}"));
    for (scene, [first, second]) in &paired.scenes {
        let flips = [first.flip, second.flip].map(|flip| format!("{flip:.4}"));
        let bleeds = [first.bleed, second.bleed].map(bleed);
        table.push(scene, flips.into_iter().chain(bleeds));
    }
    let mut text = table.text();
    let flip = format!(
        "FLIP of {} against {}: {}: {}",
        names[1],
        names[0],
        paired.flip.text(percent),
        verdict_text(&paired.flip, names)
    );
    push_wrapped(&mut text, 0, &flip);
    if let Some(bleed) = &paired.bleed {
        let bleed = format!(
            "lateral bleed of {} against {}: {}: {}",
            names[1],
            names[0],
            bleed.text(|bleed| format!("{bleed:+.3} px")),
            match bleed.verdict {
                Preference::Undecided if bleed.is_no_worse(LEAST_BLEED) => {
                    "undecided, and no worse".to_owned()
                }
                _ => verdict_text(bleed, names),
            }
        );
        push_wrapped(&mut text, 0, &bleed);
    }
    text
}

fn verdict_text(difference: &Difference, names: [&str; 2]) -> String {
    match difference.verdict {
        Preference::First => format!("{} is better", names[0]),
        Preference::Second => format!("{} is better", names[1]),
        Preference::Undecided => "undecided".to_owned(),
    }
}

/// Formats a mean of logs as a change of the error.
fn percent(log: f64) -> String {
    format!("{:+.1} %", 100.0 * log.exp_m1())
}
