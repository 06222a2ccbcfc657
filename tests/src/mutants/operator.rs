//! Operators: the kinds of changes that mutants make to kernels.

use std::ops::Range;

use super::Mutant;
use super::tokens::{Kind, Token};

/// A kind of change that mutants make to kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Operator {
    /// A number doubled or halved; a whole number one larger or smaller.
    Constant,
    /// Plus for minus, times for divided by, and back; a minus in front of a value dropped.
    Sign,
    /// A comparison with its border moved or its sides exchanged; "and" for "or"; a "not" dropped.
    Comparison,
    /// Components of a vector exchanged.
    Component,
    /// The smaller for the larger, the sine for the cosine; `abs` or `saturate` left out.
    Function,
    /// A statement dropped.
    Statement,
}

/// Signs, comparisons and functions, with their replacements.
#[rustfmt::skip]
const SIGNS: [(&str, &[&str]); 8] = [
    ("+", &["-"]), ("-", &["+"]), ("*", &["/"]), ("/", &["*"]),
    ("+=", &["-="]), ("-=", &["+="]), ("*=", &["/="]), ("/=", &["*="]),
];
#[rustfmt::skip]
const COMPARISONS: [(&str, &[&str]); 9] = [
    ("<", &["<=", ">="]), ("<=", &["<", ">"]), (">", &[">=", "<="]), (">=", &[">", "<"]),
    ("==", &["!="]), ("!=", &["=="]), ("&&", &["||"]), ("||", &["&&"]), ("!", &[""]),
];
#[rustfmt::skip]
const FUNCTIONS: [(&str, &[&str]); 8] = [
    ("min", &["max"]), ("max", &["min"]), ("floor", &["ceil"]), ("ceil", &["floor"]),
    ("sin", &["cos"]), ("cos", &["sin"]), ("abs", &[""]), ("saturate", &[""]),
];

/// Words that begin a declaration.
const DECLARATIONS: [&str; 5] = ["let", "var", "const", "alias", "override"];

impl Operator {
    /// Every operator.
    pub const ALL: [Self; 6] = [
        Self::Constant,
        Self::Sign,
        Self::Comparison,
        Self::Component,
        Self::Function,
        Self::Statement,
    ];

    /// Returns the word for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Sign => "sign",
            Self::Comparison => "comparison",
            Self::Component => "component",
            Self::Function => "function",
            Self::Statement => "statement",
        }
    }

    /// Makes every mutant of this kind, from top to bottom.
    pub(super) fn mutants(self, tokens: &[Token]) -> Vec<Mutant> {
        if self == Self::Statement {
            let dropped = find_statements(tokens).into_iter();
            return dropped.map(|place| self.mutant(place, "")).collect();
        }
        let places = tokens.iter().enumerate();
        places
            .flat_map(|(at, token)| {
                let place = token.start..token.start + token.text.len();
                let replacements = self.replacements(&tokens[..at], token).into_iter();
                replacements.map(move |text| self.mutant(place.clone(), &text))
            })
            .collect()
    }

    fn mutant(self, place: Range<usize>, replacement: &str) -> Mutant {
        Mutant {
            operator: self,
            place,
            replacement: replacement.to_owned(),
        }
    }

    /// Lists the replacements of a token.
    fn replacements(self, before: &[Token], token: &Token) -> Vec<String> {
        let text = token.text;
        let is_component = before.last().is_some_and(|last| last.text == ".");
        let found = |table: &[(&str, &[&str])]| -> Vec<String> {
            let rows = table.iter().filter(|(from, _)| *from == text);
            let replacements = rows.flat_map(|(_, to)| to.iter());
            replacements.map(|to| (*to).to_owned()).collect()
        };
        match (self, token.kind) {
            (Self::Constant, Kind::Number) => change_number(text),
            (Self::Sign, Kind::Sign) if text == "-" && is_prefix(before) => vec![String::new()],
            (Self::Sign, Kind::Sign) => found(&SIGNS),
            (Self::Comparison, Kind::Sign) => found(&COMPARISONS),
            (Self::Component, Kind::Word) if is_component => swap_components(text),
            (Self::Function, Kind::Word) if !is_component => found(&FUNCTIONS),
            _ => Vec::new(),
        }
    }
}

/// Returns whether a minus after these tokens is in front of a value, and not between two.
fn is_prefix(before: &[Token]) -> bool {
    before.last().is_none_or(|last| match last.kind {
        Kind::Number => false,
        Kind::Word => last.text == "return",
        Kind::Sign => !matches!(last.text, ")" | "]"),
    })
}

/// Doubles and halves a number; a zero becomes one. A whole number becomes one larger and one smaller, but not negative.
fn change_number(text: &str) -> Vec<String> {
    if let Some(digits) = text.strip_prefix("0x") {
        let (digits, suffix) = split_suffix(digits, &['i', 'u']);
        let value = u64::from_str_radix(digits, 16).unwrap_or_default();
        return vec![format!("0x{:x}{suffix}", value + 1)];
    }
    let (digits, suffix) = split_suffix(text, &['i', 'u', 'f', 'h']);
    if let Ok(value) = digits.parse::<u64>()
        && !matches!(suffix, "f" | "h")
    {
        let smaller = value.checked_sub(1);
        let values = std::iter::once(value + 1).chain(smaller);
        return values.map(|value| format!("{value}{suffix}")).collect();
    }
    let values = match digits.parse::<f64>() {
        Ok(0.0) => vec![1.0],
        Ok(value) => vec![2.0 * value, 0.5 * value],
        Err(_) => Vec::new(),
    };
    (values.into_iter())
        .map(|value| format!("{value:?}{suffix}"))
        .collect()
}

fn split_suffix<'t>(text: &'t str, suffixes: &[char]) -> (&'t str, &'t str) {
    let digits = text.trim_end_matches(suffixes);
    text.split_at(digits.len())
}

/// Exchanges `x` and `y`, replaces `z` and `w` with `x`, and reverses the order of several.
fn swap_components(text: &str) -> Vec<String> {
    let is_component = |sign| matches!(sign, 'x' | 'y' | 'z' | 'w');
    if text.len() > 4 || !text.chars().all(is_component) {
        return Vec::new();
    }
    let swapped: String = match text {
        "x" => "y".to_owned(),
        "y" | "z" | "w" => "x".to_owned(),
        several => several.chars().rev().collect(),
    };
    match swapped == text {
        true => Vec::new(),
        false => vec![swapped],
    }
}

/// Finds every statement in a function that declares nothing and has no block, with its semicolon.
fn find_statements(tokens: &[Token]) -> Vec<Range<usize>> {
    let (mut braces, mut brackets) = (0, 0);
    let mut first: Option<&Token> = None;
    let mut found = Vec::new();
    for token in tokens {
        match token.text {
            "(" | "[" => brackets += 1,
            ")" | "]" => brackets -= 1,
            "{" | "}" => {
                braces += if token.text == "{" { 1 } else { -1 };
                first = None;
                continue;
            }
            ";" if brackets == 0 => {
                if let Some(first) = first.take()
                    && braces > 0
                    && !DECLARATIONS.contains(&first.text)
                {
                    found.push(first.start..token.start + 1);
                }
                continue;
            }
            _ => {}
        }
        first = first.or(Some(token));
    }
    found
}
