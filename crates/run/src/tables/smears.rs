//! Lengths and sides of smears, measured on the scene that calibrates them.

use measure::Case;
use metrics::Smear;

use super::{Table, legend_text};
use terminal::output::{Text, good, heading};

/// The scene that lengths are printed for: one object moves, and every filter should get it right.
const SCENE: &str = "sliding_panel";
/// Most smears that are printed.
const MOST: usize = 12;

/// Returns whether smears of a scene, which may be a variant, are printed.
pub fn shows_smears(scene: &str) -> bool {
    scene.split('@').next() == Some(SCENE)
}

/// Makes the table of the filters' smears on the scene that calibrates them; empty without it.
pub fn smears_text(cases: &[Case]) -> Text {
    let all = cases.iter().filter_map(|case| {
        let smear = case.smear.as_ref()?;
        shows_smears(&case.scene.to_string()).then_some((case, smear))
    });
    let smears: Vec<(&Case, &Smear)> = all.collect();
    let Some((first, _)) = smears.first() else {
        return Text::default();
    };
    let scene = &first.scene;
    let mut table = Table::new(
        "smear over the exposure",
        ["length", "from", "to", "verdict"],
    );
    table = table.with_words_in(4);
    table.push_text(heading(&scene.to_string()));
    let shown = smears
        .iter()
        .filter(|(case, _)| case.scene == *scene)
        .take(MOST);
    for (case, smear) in shown {
        let numbers =
            [smear.length(), smear.open, smear.close].map(|number| format!("{number:.2}"));
        let cells = numbers.map(Text::from).into_iter();
        table.push(case.name(), cells.chain([verdict(smear, case)]));
    }
    Text::from("\n") + table.text() + legend_text(KEY)
}

/// Meaning of the numbers.
const KEY: &str = "In exposures, by the even smear that fits the picture of the mover best: a trailing shutter is open from -1 to 0, a \
                   centred one from -0.5 to 0.5.";

fn verdict(smear: &Smear, case: &Case) -> Text {
    let words = smear.verdict(case.alignment);
    if smear.is_right(case.alignment) {
        good(&words)
    } else {
        words.into()
    }
}
