//! Mutants of kernels: copies of WGSL text with one token changed or one statement dropped.

mod operator;
mod tokens;

use std::ops::Range;

pub use operator::Operator;

/// One change of a text of kernels.
#[derive(Clone, Debug, PartialEq)]
pub struct Mutant {
    /// Kind of the change.
    pub operator: Operator,
    /// Range of replaced bytes.
    pub place: Range<usize>,
    /// The replacement.
    pub replacement: String,
}

impl Mutant {
    /// Lists every mutant of a text, operator by operator, from top to bottom.
    pub fn all(kernels: &str) -> Vec<Self> {
        let tokens = tokens::split(kernels);
        let all = Operator::ALL.into_iter();
        all.flat_map(|operator| operator.mutants(&tokens)).collect()
    }

    /// Makes the text with this change.
    pub fn apply(&self, kernels: &str) -> String {
        let (before, after) = (&kernels[..self.place.start], &kernels[self.place.end..]);
        format!("{before}{}{after}", self.replacement)
    }

    /// Describes the change by its line and column: `12:9 "0.5" becomes "1.0"`. No two mutants of a text have the same description.
    pub fn describe(&self, kernels: &str) -> String {
        let before = &kernels[..self.place.start];
        let line = before.matches('\n').count() + 1;
        let own = before.chars().rev().take_while(|sign| *sign != '\n');
        let column = own.count() + 1;
        let replaced: Vec<&str> = kernels[self.place.clone()].split_whitespace().collect();
        let becomes = match self.replacement.as_str() {
            "" => "is dropped".to_owned(),
            text => format!("becomes \"{text}\""),
        };
        format!("{line}:{column} \"{}\" {becomes}", replaced.join(" "))
    }

    /// Returns the trimmed line where the change begins.
    pub fn line<'t>(&self, kernels: &'t str) -> &'t str {
        let start = kernels[..self.place.start]
            .rfind('\n')
            .map_or(0, |end| end + 1);
        kernels[start..].lines().next().unwrap_or_default().trim()
    }
}

/// Chooses up to `count` mutants: equally many of each operator, or all that it has, spread evenly over the text.
pub fn choose_mutants(all: &[Mutant], count: usize) -> Vec<Mutant> {
    let mut groups: Vec<Vec<&Mutant>> = (Operator::ALL.into_iter())
        .map(|operator| (all.iter().filter(|mutant| mutant.operator == operator)).collect())
        .collect();
    // The smallest groups first: what they lack is left to the larger ones.
    groups.sort_by_key(Vec::len);
    let mut left = count;
    let mut chosen = Vec::new();
    for (at, group) in groups.iter().enumerate() {
        let share = (left / (groups.len() - at)).min(group.len());
        chosen.extend((0..share).map(|pick| group[pick * group.len() / share].clone()));
        left -= share;
    }
    chosen.sort_by_key(|mutant| (mutant.operator, mutant.place.start));
    chosen
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    const KERNELS: &str = include_str!("kernels.wgsl");

    #[test]
    fn each_operator_makes_its_changes_of_numbers_signs_names_and_statements() {
        let all = Mutant::all(KERNELS);
        let mut text = String::new();
        for operator in Operator::ALL {
            text += &format!("{}\n", operator.name());
            for mutant in all.iter().filter(|mutant| mutant.operator == operator) {
                text += &format!("{}\n", mutant.describe(KERNELS));
            }
        }
        assert_eq!(text, include_str!("mutants.txt"));
    }

    #[test]
    fn a_mutant_changes_one_place_and_knows_its_line() {
        let all = Mutant::all(KERNELS);
        for mutant in &all {
            let text = mutant.apply(KERNELS);
            let grown = text.len() + mutant.place.len() - mutant.replacement.len();
            assert_eq!(grown, KERNELS.len(), "{mutant:?}");
            assert_ne!(text, KERNELS, "{mutant:?}");
        }
        let border = all.iter().find(|it| it.replacement == "<=").unwrap();
        assert_eq!(border.line(KERNELS), "for (var i = 0; i < 4u; i++) {");
        assert!(border.apply(KERNELS).contains("i <= 4u; i++"));
        let names: BTreeSet<String> = all.iter().map(|one| one.describe(KERNELS)).collect();
        assert_eq!(names.len(), all.len());
    }

    #[test]
    fn chosen_mutants_are_spread_over_operators_and_text() {
        let all = Mutant::all(KERNELS);
        assert_eq!(choose_mutants(&all, 1000), all);
        let counts = |count: usize| {
            let chosen = choose_mutants(&all, count);
            let own = |operator| chosen.iter().filter(move |it| it.operator == operator);
            Operator::ALL.map(|operator| own(operator).count())
        };
        assert_eq!(counts(12), [2, 2, 2, 2, 2, 2]);
        // There are only 2 functions.
        assert_eq!(counts(19), [4, 3, 4, 3, 2, 3]);
        let constants = choose_mutants(&all, 12);
        let picked = [&all[0], &all[5]];
        assert_eq!(constants[..2].iter().collect::<Vec<_>>(), picked);
    }
}
