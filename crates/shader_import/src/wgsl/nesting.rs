//! Limit on the nesting of kernels: parsers and compilers recurse as deeply.

use std::path::Path;

use crate::fault::FileFault;

/// Upper limit on operators, brackets and `else if` within one another: a sum of that many terms
/// and one more.
pub const MAX_NESTING: usize = 1000;

/// Refuses kernels with an expression, a statement or a type that is nested more deeply than
/// [`MAX_NESTING`].
///
/// A sum `a + b + c` is `(a + b) + c` to a parser, so each operator counts as a level until the
/// next `,` or `;`.
pub fn check_nesting(path: &Path, kernels: &str) -> Result<(), FileFault> {
    let mut nesting = Nesting::default();
    let mut rest = kernels;
    while let Some(first) = rest.chars().next() {
        let blank = measure_blank(rest);
        if blank > 0 {
            rest = &rest[blank..];
            continue;
        }
        let (token, length) = match measure_word(rest) {
            0 => (Token::Mark(first), first.len_utf8()),
            length => (Token::Word(&rest[..length]), length),
        };
        if nesting.enter(token) > MAX_NESTING {
            let before = &kernels[..kernels.len() - rest.len()];
            return Err(FileFault::new(
                path,
                before.matches('\n').count() + 1,
                format!(
                    "more than {MAX_NESTING} operators, brackets or else-branches lie within one another here; allowed: \
                     at most {MAX_NESTING}; divide the expression among several statements"
                ),
            ));
        }
        rest = &rest[length..];
    }
    Ok(())
}

/// A piece of WGSL that is neither blank nor a comment.
enum Token<'a> {
    /// A name, keyword or number.
    Word(&'a str),
    /// Any other character.
    Mark(char),
}

/// Measures the blanks or the comment that a text begins with, in bytes; comments may be nested.
fn measure_blank(text: &str) -> usize {
    if text.starts_with("//") {
        return text.find('\n').unwrap_or(text.len());
    }
    let mut depth = 0;
    let mut at = 0;
    while let Some(here) = text.as_bytes().get(at..at + 2) {
        match here {
            b"/*" => depth += 1,
            b"*/" if depth > 0 => depth -= 1,
            _ if depth == 0 => break,
            _ => {
                at += 1;
                continue;
            }
        }
        at += 2;
    }
    match (at, depth) {
        (0, _) => text.len() - text.trim_start().len(),
        (end, 0) => end,
        _ => text.len(),
    }
}

/// Measures the word or number that a text begins with, in bytes.
fn measure_word(text: &str) -> usize {
    let is_number = text.starts_with(|c: char| c.is_ascii_digit());
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || (is_number && c == '.');
    text.find(|c| !is_part(c)).unwrap_or(text.len())
}

/// The levels that are open.
#[derive(Default)]
struct Nesting {
    /// Operators since the last `,` or `;` outside of any bracket.
    operators: usize,
    /// Operators before each open bracket.
    outside: Vec<usize>,
    /// All operators of `operators` and `outside`.
    sum: usize,
    /// True if a `}` came last: it ends a statement unless an `else` follows.
    after_block: bool,
}

impl Nesting {
    /// Reads the next token; returns its depth.
    fn enter(&mut self, token: Token) -> usize {
        let goes_on = matches!(token, Token::Word("else"));
        if std::mem::take(&mut self.after_block) && !goes_on {
            self.reset();
        }
        match token {
            Token::Mark('(' | '[' | '{') => {
                self.outside.push(self.operators);
                self.operators = 0;
            }
            Token::Mark(close @ (')' | ']' | '}')) => {
                self.reset();
                self.operators = self.outside.pop().unwrap_or(0);
                self.after_block = close == '}';
                // An index of an index.
                self.add(usize::from(close == ']'));
            }
            Token::Mark(',' | ';') => self.reset(),
            Token::Mark(_) | Token::Word("else") => self.add(1),
            Token::Word(_) => {}
        }
        self.sum + self.outside.len()
    }

    fn add(&mut self, operators: usize) {
        self.operators += operators;
        self.sum += operators;
    }

    fn reset(&mut self) {
        self.sum -= self.operators;
        self.operators = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused_line(kernels: &str) -> Option<usize> {
        match check_nesting(Path::new("k.wgsl"), kernels) {
            Ok(()) => None,
            Err(fault) => fault.line,
        }
    }

    #[test]
    fn sums_brackets_types_and_branches_count() {
        let deep = |count: usize| {
            let branches: String = (0..count).map(|_| "else if a { }".to_owned()).collect();
            [
                format!("let x =\n1{};", "+ 1".repeat(count)),
                format!("let x =\n{}1{};", "(".repeat(count), ")".repeat(count)),
                format!("let x =\n{}a;", "-".repeat(count)),
                format!("let x\n= a{};", "[0]".repeat(count)),
                format!("let x\n= a{};", ".x".repeat(count)),
                format!(
                    "var x:\n{}f32{};",
                    "array<".repeat(count),
                    ">".repeat(count)
                ),
                format!("fn f()\n{}{}", "{".repeat(count), "}".repeat(count)),
                format!("if a {{ }}\n{branches}"),
                format!("x\n= {}1{};", "f(1, ".repeat(count), ")".repeat(count)),
            ]
        };
        for text in deep(MAX_NESTING + 1) {
            assert_eq!(refused_line(&text), Some(2), "{}", &text[..40]);
        }
        // A few levels are there already: = and the like.
        for text in deep(MAX_NESTING / 2 - 2) {
            assert_eq!(refused_line(&text), None, "{}", &text[..40]);
        }
    }

    #[test]
    fn long_lists_and_many_statements_are_not_deep() {
        let many = 10 * MAX_NESTING;
        assert_eq!(refused_line(&"x += 1.0e-3 * a[0].x;\n".repeat(many)), None);
        assert_eq!(
            refused_line(&format!("f({})", "vec2(1, -2), ".repeat(many))),
            None
        );
        assert_eq!(refused_line(&"if a { b; } ".repeat(many)), None);
        assert_eq!(
            refused_line(&format!(
                "/* {} /* */ */ // {}",
                "(".repeat(many),
                "(".repeat(many)
            )),
            None
        );
        assert_eq!(refused_line("/* no end"), None);
    }
}
