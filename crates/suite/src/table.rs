//! The tables that a run prints, in 80 columns: one line per case, then means over the scenes.

use std::fmt::Write;

use metrics::Scores;

use crate::headline::{
    FLIP, GROWTH, Headline, LABEL, LOSS, PSNR, SKILL, SKILL_LABEL, SKILL_MSE, SUBFRAMES,
};
use crate::overall::ranked;
use crate::run::Run;
use crate::wrapped::push_wrapped;
use crate::{Case, Overall, paint};

/// Columns that names take.
const NAMES: usize = 29;

/// Title and width.
type Column = (&'static str, usize, Headline);

const OF_CASES: [Column; 7] = [
    ("FLIP", 6, FLIP),
    ("skill", 6, SKILL),
    ("grow", 5, GROWTH),
    ("loss", 5, LOSS),
    ("bleed", 6, Headline::Bleed),
    ("TV", 6, LABEL),
    ("N_eq", 5, SUBFRAMES),
];
/// Of the columns that a run has beside the scores.
const WIDTH: usize = 6;
/// Behind the score that filters of one alignment are ranked by.
const OF_MEANS: [Column; 5] = [
    ("PSNR", 6, PSNR),
    ("grow", 5, GROWTH),
    ("loss", 5, LOSS),
    ("bleed", 6, Headline::Bleed),
    ("TV", 6, LABEL),
];
/// Behind the skill that filters of all alignments are ranked by.
const OF_SKILLS: [Column; 3] = [
    ("MSE", 6, SKILL_MSE),
    ("TV", 6, SKILL_LABEL),
    ("FLIP*", 6, Headline::CommonFlip),
];
/// Of the score that is ranked by.
const RANKED: usize = 6;
/// Of its interval.
const INTERVAL: usize = 16;
const SHUTTER: usize = 10;

/// The run as text; a score that does not apply is `n/a`.
pub fn table(run: &Run) -> String {
    let mut text = heading("scene / filter", &["noise", "FLIP*"]);
    for scene in once(run.cases.iter().map(|case| case.scene.as_str())) {
        let of_scene = || run.cases.iter().filter(|case| case.scene == scene);
        for alignment in once(of_scene().map(|case| case.alignment.as_str())) {
            let title = format!("{scene}, {alignment} shutter");
            let _ = writeln!(text, "{}", paint::heading(&title));
            for case in of_scene().filter(|case| case.alignment == alignment) {
                let more = [noise(case), Headline::CommonFlip.text(case)];
                let line = line(&titled(&case.name(), case.bar), &case.scores, &more);
                text += &behind(case.bar, &line);
            }
        }
    }
    text += &legend(&format!(
        "FLIP* is against the {} shutter. {KEY}",
        run.common_alignment
    ));
    text + &over_scenes(&run.overall)
}

/// What titles and marks mean.
const KEY: &str = "Skill by FLIP: 0 is [identity], 1 is [scatter_oracle]. Bleed: the largest of beside, ahead (>) and behind \
                   (<); grow, loss and bleed in pixels.";

/// The scores of one picture of a scene, in the manner of [`table`].
pub fn score_table(scene: &str, picture: &str, scores: &Scores) -> String {
    heading("scene / picture", &[])
        + &format!("{scene}\n")
        + &line(picture, scores, &[])
        + &legend(KEY)
}

/// Means over scenes, and who is best: among filters of one shutter alignment by FLIP, among all by skill. Nothing of a single
/// scene.
fn over_scenes(overall: &[Overall]) -> String {
    let mut text = String::new();
    for group in ranked(overall, FLIP) {
        let first = group[0];
        if text.is_empty() {
            text += "\n";
            text += &means_heading(overall, "FLIP", &OF_MEANS, "");
        }
        let _ = writeln!(
            text,
            "{}",
            paint::heading(&format!("{} shutter", first.alignment))
        );
        for row in group {
            text += &mean_line(overall, row, FLIP, &OF_MEANS, "");
        }
    }
    for group in ranked(overall, SKILL) {
        text += "\n";
        text += &means_heading(overall, "skill", &OF_SKILLS, "shutter");
        for row in group {
            text += &mean_line(overall, row, SKILL, &OF_SKILLS, &row.alignment);
        }
        text += &legend(
            "Skill is by FLIP, by MSE and by label TV: the share of the way from [identity], 0, to [scatter_oracle], 1; below 0 \
             is worse than doing nothing.",
        );
        text += &fewer_scenes(overall);
    }
    text
}

/// On which shutters skill by FLIP has fewer scenes than FLIP.
fn fewer_scenes(overall: &[Overall]) -> String {
    let count = |headline: Headline, alignment: &str| {
        let name = headline.name();
        let mut own = overall.iter();
        let own = own.find(|mean| mean.metric == name && mean.alignment == alignment);
        own.map_or(0, |mean| mean.scenes)
    };
    let alignments = once(overall.iter().map(|mean| mean.alignment.as_str()));
    let counted = alignments.into_iter().filter_map(|alignment| {
        let [skill, flip] = [SKILL, FLIP].map(|headline| count(headline, alignment));
        (skill < flip).then(|| format!("{skill} of {flip} {alignment}"))
    });
    let counted: Vec<String> = counted.collect();
    match counted.is_empty() {
        true => String::new(),
        false => legend(&format!(
            "Scenes that skill applies to: {}. On the others the oracle gains no more than noise makes.",
            counted.join(", ")
        )),
    }
}

fn means_heading(overall: &[Overall], by: &str, others: &[Column], shutter: &str) -> String {
    let scenes = overall.iter().map(|mean| mean.scenes).max().unwrap_or(0);
    let mut text = format!("{:<NAMES$}", format!("mean over {scenes} scenes"));
    let _ = write!(text, "{by:>RANKED$}{:>INTERVAL$}", "95 % CI");
    for (title, width, _) in others {
        let _ = write!(text, "{title:>width$}");
    }
    if !shutter.is_empty() {
        let _ = write!(text, "{shutter:>SHUTTER$}");
    }
    paint::heading(&text) + "\n"
}

fn mean_line(
    overall: &[Overall],
    row: &Overall,
    by: Headline,
    others: &[Column],
    shutter: &str,
) -> String {
    let [low, high] = row.interval.map(|end| by.number(end));
    let mut line = name_cell(&titled(&row.filter, row.bar));
    let _ = write!(line, "{:>RANKED$}", by.number(row.mean));
    let _ = write!(line, "{:>INTERVAL$}", format!("{low} to {high}"));
    for (_, width, headline) in others {
        let name = headline.name();
        let own = (overall.iter()).find(|mean| mean.metric == name && mean.is_of_same(row));
        let cell = own.map_or("n/a".to_owned(), |own| headline.number(own.mean));
        let _ = write!(line, "{cell:>width$}");
    }
    if !shutter.is_empty() {
        let _ = write!(line, "{shutter:>SHUTTER$}");
    }
    behind(row.bar, &(line + "\n"))
}

/// Bars stand in brackets: they are no filters.
fn titled(name: &str, bar: bool) -> String {
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

fn legend(words: &str) -> String {
    let mut text = String::new();
    push_wrapped(&mut text, 0, words);
    paint::faint(&text)
}

/// Bars stand behind.
fn behind(bar: bool, lines: &str) -> String {
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
fn name_cell(name: &str) -> String {
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

fn once<'a>(all: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut once = Vec::new();
    for one in all {
        if !once.contains(&one) {
            once.push(one);
        }
    }
    once
}
