//! Mutants: copies of a text of kernels with one place changed.

/// Kinds of changes: a name, and texts with their replacements.
#[rustfmt::skip]
pub const OPERATORS: [(&str, &[(&str, &str)]); 5] = [
    ("constant", &[
        ("0", "1"), ("1", "2"), ("2", "3"), ("0.0", "1.0"), ("0.5", "1.0"), ("1.0", "2.0"),
        ("1.0", "0.5"), ("2.0", "1.0"),
    ]),
    ("sign", &[
        (" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * "), (" += ", " -= "),
        (" = -", " = "), ("(-", "("),
    ]),
    ("comparison", &[
        (" < ", " <= "), (" < ", " >= "), (" <= ", " < "), (" > ", " >= "), (" > ", " <= "),
        (" >= ", " > "), (" == ", " != "), (" != ", " == "), (" && ", " || "), (" || ", " && "),
    ]),
    ("component", &[
        (".x", ".y"), (".y", ".x"), (".z", ".x"), (".w", ".x"), (".xy", ".yx"), (".zw", ".wz"),
    ]),
    ("function", &[
        ("min(", "max("), ("max(", "min("), ("floor(", "ceil("), ("ceil(", "floor("),
        ("sin(", "cos("), ("cos(", "sin("), ("abs(", "("), ("saturate(", "("),
    ]),
];

/// One change of a text of kernels.
#[derive(Clone)]
pub struct Mutant {
    /// Name of the kind of change.
    pub operator: &'static str,
    /// First byte of the changed place.
    start: usize,
    /// The text there, and its replacement.
    change: (&'static str, &'static str),
}

impl Mutant {
    /// Chooses up to `count` mutants of each kind, spread evenly over the text.
    pub fn choose(kernels: &str, count: usize) -> Vec<Self> {
        let mut chosen = Vec::new();
        for (operator, changes) in OPERATORS {
            let mut all = Vec::new();
            for change in changes {
                for (start, text) in kernels.match_indices(change.0) {
                    if is_code(&kernels[..start]) && is_whole(kernels, start, text) {
                        all.push(Self {
                            operator,
                            start,
                            change: *change,
                        });
                    }
                }
            }
            all.sort_by_key(|mutant| mutant.start);
            let count = count.min(all.len());
            chosen.extend((0..count).map(|at| all[at * all.len() / count].clone()));
        }
        chosen
    }

    /// Makes the text with this change.
    pub fn apply(&self, kernels: &str) -> String {
        let (before, after) = kernels.split_at(self.start);
        before.to_owned() + &after.replacen(self.change.0, self.change.1, 1)
    }

    /// Describes the change with its line: `line 12, "0.5" becomes "1.0": let half = 0.5;`
    pub fn describe(&self, kernels: &str) -> String {
        let row = kernels[..self.start].matches('\n').count();
        let line = kernels.lines().nth(row).unwrap_or_default();
        let (text, replacement) = self.change;
        format!(
            "line {}, {text:?} becomes {replacement:?}: {}",
            row + 1,
            line.trim()
        )
    }
}

/// Returns whether the place after a text is neither in a comment nor after an attribute.
fn is_code(before: &str) -> bool {
    let line = before.rsplit('\n').next().unwrap_or_default();
    !line.contains("//") && !line.contains('@')
}

/// Returns whether a text is no part of a longer word or number.
fn is_whole(kernels: &str, start: usize, text: &str) -> bool {
    let is_part = |sign: char| sign.is_alphanumeric() || sign == '_' || sign == '.';
    let begins_inside =
        kernels[..start].ends_with(is_part) && text.starts_with(char::is_alphanumeric);
    let ends_inside = kernels[start + text.len()..].starts_with(is_part) && text.ends_with(is_part);
    !begins_inside && !ends_inside
}
