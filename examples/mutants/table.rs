//! Tables of mutants.

use judge::number;

use crate::bench::Verdict;
use crate::mutant::OPERATORS;

/// Smallest change that a check should notice, in noise floors of the truth.
const NOTICEABLE: f64 = 3.0;

/// Sizes of changes in noise floors: the column's name, and the smallest and largest of it.
const SIZES: [(&str, [f64; 2]); 3] = [
    ("below 1", [0.0, 1.0]),
    ("1 to 3", [1.0, NOTICEABLE]),
    ("above 3", [NOTICEABLE, f64::INFINITY]),
];

/// Formats how many of the noticeable mutants are killed, and lists the others.
pub fn format_score(name: &str, verdicts: &[Verdict]) -> String {
    let mut noticeable: Vec<&Verdict> = verdicts.iter().collect();
    noticeable.retain(|verdict| verdict.has_picture && verdict.change > NOTICEABLE);
    let all = noticeable.len();
    noticeable.retain(|verdict| !verdict.is_killed);
    let killed = all - noticeable.len();
    let share = 100.0 * killed as f64 / all as f64;
    let mut text = format!("{name}: {killed} of {all} killed, {share:.1} %\n");
    for verdict in noticeable {
        text += &format!(
            "  {}\n      {} noise floors on {}, {:.3} times the squared error\n",
            verdict.description,
            number(verdict.change),
            verdict.scene,
            verdict.error
        );
    }
    text
}

/// Formats the numbers of killed and of all mutants by operator and by the size of their change.
pub fn format_table(verdicts: &[Verdict]) -> String {
    let mut text = format!(
        "{:10} {:>8} {:>11} {:>8}",
        "killed of", "mutants", "no picture", "same"
    );
    text.extend(SIZES.map(|(name, _)| format!(" {name:>8}")));
    for (operator, _) in OPERATORS {
        let group = verdicts.iter();
        let group = group.filter(|verdict| verdict.operator == operator);
        text += &format_row(operator, &group.collect::<Vec<_>>());
    }
    text + &format_row("all", &verdicts.iter().collect::<Vec<_>>())
}

fn format_row(name: &str, verdicts: &[&Verdict]) -> String {
    let with_picture = verdicts.iter().filter(|verdict| verdict.has_picture);
    let same = with_picture.clone().filter(|verdict| verdict.change == 0.0);
    let failed = verdicts.len() - with_picture.clone().count();
    let mut row = format!(
        "\n{name:10} {:>8} {failed:>11} {:>8}",
        verdicts.len(),
        same.count()
    );
    for (_, [smallest, largest]) in SIZES {
        let group = with_picture.clone();
        let group = group.filter(|verdict| verdict.change > smallest && verdict.change <= largest);
        let killed = group.clone().filter(|verdict| verdict.is_killed).count();
        let cell = format!("{killed}/{}", group.count());
        row += &format!(" {cell:>8}");
    }
    row
}
