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
    /// Bytes of the text that are replaced.
    pub place: Range<usize>,
    /// Text in their place.
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

    /// Describes the change by its line and column: `12:9 "0.5" becomes "1.0"`. No two mutants of a text have one description.
    pub fn describe(&self, kernels: &str) -> String {
        let before = &kernels[..self.place.start];
        let line = before.matches('\n').count() + 1;
        let column = before
            .chars()
            .rev()
            .take_while(|sign| *sign != '\n')
            .count()
            + 1;
        let replaced: Vec<&str> = kernels[self.place.clone()].split_whitespace().collect();
        let becomes = match self.replacement.as_str() {
            "" => "is dropped".to_owned(),
            text => format!("becomes \"{text}\""),
        };
        format!("{line}:{column} \"{}\" {becomes}", replaced.join(" "))
    }

    /// Returns the whole line that the change begins in, without the space around it.
    pub fn line<'t>(&self, kernels: &'t str) -> &'t str {
        let start = kernels[..self.place.start]
            .rfind('\n')
            .map_or(0, |end| end + 1);
        kernels[start..].lines().next().unwrap_or_default().trim()
    }
}

/// Chooses up to `count` mutants: as many of each operator, or all that it has, spread evenly over the text.
pub fn choose_mutants(all: &[Mutant], count: usize) -> Vec<Mutant> {
    let mut groups: Vec<Vec<&Mutant>> = (Operator::ALL.into_iter())
        .map(|operator| (all.iter().filter(|mutant| mutant.operator == operator)).collect())
        .collect();
    // The smallest groups first: what they cannot give is left to the larger ones.
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
    use super::*;

    const KERNELS: &str = "\
// A comment with 1.0 + 2.0.
const SHARPNESS = 20.0;
@group(0) @binding(1) var<uniform> parameters: Parameters;

@compute @workgroup_size(8, 8)
fn blur(@builtin(global_invocation_id) id: vec3<u32>) -> f32 {
    let half = -0.5 * max(length(vec2<f32>(id.yx)), 0.0);
    for (var i = 0; i < 4u; i++) {
        if !inside(half) || saturate(half) == 1e-5 {
            return half;
        }
        total +=
            half.x; /* 3.0 */
    }
    textureStore(output, id.xy, mean(half - total));
}
";

    /// Lists the mutants of one operator.
    fn described(operator: Operator) -> Vec<String> {
        (Mutant::all(KERNELS).iter())
            .filter(|mutant| mutant.operator == operator)
            .map(|mutant| mutant.describe(KERNELS))
            .collect()
    }

    #[test]
    fn constants_are_doubled_and_halved_or_moved_by_1() {
        let expected = [
            "2:19 \"20.0\" becomes \"40.0\"",
            "2:19 \"20.0\" becomes \"10.0\"",
            "7:17 \"0.5\" becomes \"1.0\"",
            "7:17 \"0.5\" becomes \"0.25\"",
            "7:53 \"0.0\" becomes \"1.0\"",
            "8:18 \"0\" becomes \"1\"",
            "8:25 \"4u\" becomes \"5u\"",
            "8:25 \"4u\" becomes \"3u\"",
            "9:47 \"1e-5\" becomes \"2e-5\"",
            "9:47 \"1e-5\" becomes \"5e-6\"",
        ];
        assert_eq!(described(Operator::Constant), expected);
    }

    #[test]
    fn signs_are_turned_round() {
        let expected = [
            "7:16 \"-\" is dropped",
            "7:21 \"*\" becomes \"/\"",
            "12:15 \"+=\" becomes \"-=\"",
            "15:43 \"-\" becomes \"+\"",
        ];
        assert_eq!(described(Operator::Sign), expected);
    }

    #[test]
    fn comparisons_move_by_their_border_and_are_reversed() {
        let expected = [
            "8:23 \"<\" becomes \"<=\"",
            "8:23 \"<\" becomes \">=\"",
            "9:12 \"!\" is dropped",
            "9:26 \"||\" becomes \"&&\"",
            "9:44 \"==\" becomes \"!=\"",
        ];
        assert_eq!(described(Operator::Comparison), expected);
    }

    #[test]
    fn components_are_swapped() {
        let expected = [
            "7:47 \"yx\" becomes \"xy\"",
            "13:18 \"x\" becomes \"y\"",
            "15:29 \"xy\" becomes \"yx\"",
        ];
        assert_eq!(described(Operator::Component), expected);
    }

    #[test]
    fn functions_are_exchanged_or_left_out() {
        let expected = [
            "7:23 \"max\" becomes \"min\"",
            "9:29 \"saturate\" is dropped",
        ];
        assert_eq!(described(Operator::Function), expected);
    }

    #[test]
    fn statements_are_dropped_that_declare_nothing() {
        let expected = [
            "10:13 \"return half;\" is dropped",
            "12:9 \"total += half.x;\" is dropped",
            "15:5 \"textureStore(output, id.xy, mean(half - total));\" is dropped",
        ];
        assert_eq!(described(Operator::Statement), expected);
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
        let border = all
            .iter()
            .find(|mutant| mutant.replacement == "<=")
            .unwrap();
        assert_eq!(border.line(KERNELS), "for (var i = 0; i < 4u; i++) {");
        assert!(border.apply(KERNELS).contains("i <= 4u; i++"));
        let mut names: Vec<String> = all.iter().map(|one| one.describe(KERNELS)).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), all.len());
    }

    #[test]
    fn chosen_mutants_are_spread_over_operators_and_text() {
        let all = Mutant::all(KERNELS);
        assert_eq!(choose_mutants(&all, 1000), all);
        let counts = |count: usize| {
            let chosen = choose_mutants(&all, count);
            Operator::ALL.map(|operator| {
                let own = chosen.iter().filter(|mutant| mutant.operator == operator);
                own.count()
            })
        };
        assert_eq!(counts(12), [2, 2, 2, 2, 2, 2]);
        // Only 2 functions are there.
        assert_eq!(counts(19), [4, 3, 4, 3, 2, 3]);
        let constants = choose_mutants(&all, 12);
        let picked = [&all[0], &all[5]];
        assert_eq!(constants[..2].iter().collect::<Vec<_>>(), picked);
    }
}
