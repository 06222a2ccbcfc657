//! The table that a run prints, in 80 columns: one line per case.

use std::fmt::Write;

use metrics::Scores;

use super::means::means_table;
use crate::output::paint;
use crate::output::wrapped::push_wrapped;
use suite::Case;
use suite::Headline;
use suite::Run;
use suite::printable;

/// Columns that names take.
pub(crate) const NAMES: usize = 29;

/// Title and width.
pub(crate) type Column = (&'static str, usize, Headline);

const OF_CASES: [Column; 7] = [
    ("FLIP", 6, Headline::FLIP),
    ("skill", 6, Headline::SKILL),
    ("grow", 5, Headline::GROWTH),
    ("loss", 5, Headline::LOSS),
    ("bleed", 6, Headline::Bleed),
    ("TV", 6, Headline::LABEL),
    ("N_eq", 5, Headline::SUBFRAMES),
];
/// Of the columns that a run has beside the scores.
const WIDTH: usize = 6;

/// The run as text, cases and means over the scenes; a score that does not apply is `n/a`.
pub fn table(run: &Run) -> String {
    let mut text = heading("scene / filter", &["noise", "FLIP*"]);
    for scene in once(run.cases.iter().map(|case| case.scene.as_str())) {
        let of_scene = || run.cases.iter().filter(|case| case.scene == scene);
        for alignment in once(of_scene().map(|case| case.alignment.as_str())) {
            let title = format!("{scene}, {alignment} shutter");
            let _ = writeln!(text, "{}", paint::heading(&title));
            for case in of_scene().filter(|case| case.alignment == alignment) {
                let more = [noise(case), Headline::CommonFlip.text(case)];
                let line = line(
                    &titled(&case.name(), case.is_reference),
                    &case.scores,
                    &more,
                );
                text += &behind(case.is_reference, &line);
            }
        }
    }
    text += &legend(&format!(
        "FLIP* is against the {} shutter. {KEY}",
        run.common_alignment
    ));
    text + &means_table(&run.overall)
}

/// What titles and marks mean.
const KEY: &str = "Skill by Headline::FLIP: 0 is [identity], 1 is [scatter_oracle]. Bleed: the largest of beside, ahead (>) and behind \
                   (<); grow, loss and bleed in pixels.";

/// The scores of one picture of a scene, in the manner of [`table`].
pub fn score_table(scene: &str, picture: &str, scores: &Scores) -> String {
    heading("scene / picture", &[])
        + &format!("{}\n", printable(scene))
        + &line(&printable(picture), scores, &[])
        + &legend(KEY)
}

/// Bars stand in brackets: they are no filters.
pub(crate) fn titled(name: &str, bar: bool) -> String {
    match bar {
        true => format!("[{name}]"),
        false => name.to_owned(),
    }
}

fn heading(title: &str, more: &[&str]) -> String {
    let mut text = format!("{title:<NAMES$}");
    for (title, width, _) in OF_CASES {
        let _ = write!(text, "{title:>width$}");
    }
    for title in more {
        let _ = write!(text, "{title:>WIDTH$}");
    }
    paint::heading(&text) + "\n"
}

/// What a table's words mean, below it.
pub(crate) fn legend(words: &str) -> String {
    let mut text = String::new();
    push_wrapped(&mut text, 0, words);
    paint::faint(&text)
}

/// Bars stand behind.
pub(crate) fn behind(bar: bool, lines: &str) -> String {
    match bar {
        true => paint::faint(lines),
        false => lines.to_owned(),
    }
}

fn line(name: &str, scores: &Scores, more: &[String]) -> String {
    let mut text = name_cell(name);
    for (_, width, headline) in OF_CASES {
        let _ = write!(text, "{:>width$}", headline.text_of_scores(scores));
    }
    for cell in more {
        let _ = write!(text, "{cell:>WIDTH$}");
    }
    text + "\n"
}

/// A long name has a line of its own.
pub(crate) fn name_cell(name: &str) -> String {
    match name.chars().count() > NAMES - 2 {
        true => format!("  {name}\n{:<NAMES$}", ""),
        false => format!("  {name:<0$}", NAMES - 2),
    }
}

/// The part of the squared error that is the filter's noise.
fn noise(case: &Case) -> String {
    let share = case.jitter.map(|jitter| 100.0 * jitter.noise_share());
    share.map_or("-".to_owned(), |share| format!("{share:.0}%"))
}

/// Each text once, in their order.
pub(crate) fn once<'a>(all: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut once = Vec::new();
    for one in all {
        if !once.contains(&one) {
            once.push(one);
        }
    }
    once
}
