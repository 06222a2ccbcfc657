//! A finished tuning as text.

use super::compare::{Difference, Paired, Preference};
use super::loss::LEAST_BLEED;
use super::{Trial, Tuning};

/// Rows of the front that are printed; `tune.json` has all.
const ROWS: usize = 12;

/// Start, front, choice, folds and sealed scenes.
pub fn tuning_table(tuning: &Tuning) -> String {
    let journal = &tuning.journal;
    let mut text = format!(
        "{}:{}, {} trials on {} scenes: {} dropped early, {} failed\n\n",
        journal.filter,
        journal.start,
        tuning.trials,
        journal.scenes.len(),
        tuning.dropped,
        tuning.failed.len(),
    );
    text += "trial    error    bleed     cost  values that differ from the start\n";
    let mut rows = vec![&tuning.start];
    rows.extend(tuning.front.iter().take(ROWS));
    if !rows.iter().any(|row| row.trial == tuning.chosen.trial) {
        rows.push(&tuning.chosen);
    }
    for (index, trial) in rows.iter().enumerate() {
        if index == 0 || trial.trial != 0 {
            text += &row(trial, &tuning.start, tuning.chosen.trial);
        }
    }
    if tuning.front.len() > ROWS {
        text += &format!("and {} more in tune.json\n", tuning.front.len() - ROWS);
    }
    text += &format!(
        "\nchosen: trial {}, {}; the best is trial {}, and {} lies within its standard error of {:.3}\n",
        tuning.choice.trial,
        percent(tuning.chosen.error.expect("the choice is done")),
        tuning.choice.best,
        match tuning.choice.trial == tuning.choice.best {
            true => "nothing nearer to the start",
            false => "the chosen one, nearer to the start,",
        },
        tuning.choice.standard_error,
    );
    if tuning.choice.trial == 0 {
        text += "no trial beats the start by more than the scenes can tell\n";
    }
    if !tuning.folds.is_empty() {
        text += "\nfamily left out  scenes  trial  on the others  on the family    gap\n";
        for fold in &tuning.folds {
            text += &format!(
                "{:15} {:7} {:6} {:14.3} {:14.3} {:6.3}\n",
                fold.family, fold.scenes, fold.trial, fold.others, fold.held_out, fold.gap
            );
        }
    }
    if let Some(last) = tuning.openings.last() {
        text += &format!(
            "\nsealed scenes, opened {} at {}x{}, {} samples per pixel:\n",
            match tuning.openings.len() {
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
        text += &format!("failed: trial {trial}: {reason}\n");
    }
    text
}

fn row(trial: &Trial, start: &Trial, chosen: usize) -> String {
    let changed: Vec<String> = (trial.values.iter())
        .filter(|(name, value)| start.values[*name] != **value)
        .map(|(name, value)| format!("{name}={value}"))
        .collect();
    let number = |value: Option<f64>| match value {
        Some(value) => format!("{value:8.3}"),
        None => format!("{:>8}", "-"),
    };
    format!(
        "{:4}{} {} {} {}  {}\n",
        trial.trial,
        if trial.trial == chosen { "*" } else { " " },
        number(trial.error),
        number(trial.bleed),
        number(trial.cost),
        match trial.trial {
            0 => "the start".to_owned(),
            _ => changed.join(" "),
        }
    )
}

/// Two candidates scene by scene, and the verdicts.
pub fn paired_table(paired: &Paired, names: [&str; 2]) -> String {
    let width = paired
        .scenes
        .keys()
        .map(String::len)
        .max()
        .unwrap_or(0)
        .max(5);
    let mut text = format!(
        "{:width$}  {:>9} FLIP {:>9} FLIP {:>9} bleed {:>9} bleed\n",
        "scene", names[0], names[1], names[0], names[1]
    );
    let bleed = |bleed: Option<f64>| bleed.map_or("n/a".to_owned(), |bleed| format!("{bleed:.3}"));
    for (scene, [first, second]) in &paired.scenes {
        text += &format!(
            "{scene:width$}  {:14.4} {:14.4} {:>15} {:>15}\n",
            first.flip,
            second.flip,
            bleed(first.bleed),
            bleed(second.bleed)
        );
    }
    let Difference {
        mean,
        bounds,
        scenes,
        ..
    } = &paired.flip;
    text += &format!(
        "FLIP of {} against {}: {} ({} to {}) over {scenes} scenes: {}\n",
        names[1],
        names[0],
        percent(*mean),
        percent(bounds[0]),
        percent(bounds[1]),
        verdict(&paired.flip, names)
    );
    if let Some(bleed) = &paired.bleed {
        text += &format!(
            "bleed of {} against {}: {:+.3} px ({:+.3} to {:+.3}) over {} scenes: {}\n",
            names[1],
            names[0],
            bleed.mean,
            bleed.bounds[0],
            bleed.bounds[1],
            bleed.scenes,
            match bleed.verdict {
                Preference::Undecided if bleed.is_no_worse(LEAST_BLEED) => {
                    "undecided, and no worse".to_owned()
                }
                _ => verdict(bleed, names),
            }
        );
    }
    text
}

fn verdict(difference: &Difference, names: [&str; 2]) -> String {
    match difference.verdict {
        Preference::First => format!("{} is better", names[0]),
        Preference::Second => format!("{} is better", names[1]),
        Preference::Undecided => "undecided".to_owned(),
    }
}

/// A mean of logs as a change of the error.
fn percent(log: f64) -> String {
    format!("{:+.1} %", 100.0 * log.exp_m1())
}
