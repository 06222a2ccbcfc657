//! Limit on the nesting of kernels: parsers and compilers recurse as deep.

use std::path::Path;

use crate::FilterError;

/// Upper limit on operators, brackets and `else if` within one another: a sum of that many terms and one more.
pub const MAX_NESTING: usize = 1000;

/// Refuses kernels with an expression, a statement or a type that is nested deeper than [`MAX_NESTING`].
///
/// A sum `a + b + c` is `(a + b) + c` to a parser, so each operator counts as a level until the next `,` or `;`.
pub(super) fn check_nesting(path: &Path, kernels: &str) -> Result<(), FilterError> {
    let mut nesting = Nesting::default();
    let mut line = 1;
    let mut rest = kernels;
    while let Some(token) = Token::take(&mut rest) {
        if let Token::Blank(text) = token {
            line += text.matches('\n').count();
            continue;
        }
        if nesting.enter(token) > MAX_NESTING {
            return Err(FilterError::in_file(
                path,
                line,
                format!(
                    "more than {MAX_NESTING} operators, brackets or else-branches lie within one another here; allowed: \
                     at most {MAX_NESTING}; divide the expression among several statements"
                ),
            ));
        }
    }
    Ok(())
}

/// A piece of WGSL, as far as it matters here.
#[derive(Clone, Copy)]
enum Token<'a> {
    /// Blanks and comments.
    Blank(&'a str),
    /// A name, keyword or number.
    Word(&'a str),
    /// Any other character.
    Mark(char),
}

impl<'a> Token<'a> {
    /// Takes the first token from the text.
    fn take(rest: &mut &'a str) -> Option<Self> {
        let text = *rest;
        let first = text.chars().next()?;
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let end = |is_inside: fn(char) -> bool| text.find(|c| !is_inside(c)).unwrap_or(text.len());
        let (length, token): (usize, fn(&'a str) -> Self) = if first.is_whitespace() {
            (end(char::is_whitespace), Self::Blank)
        } else if text.starts_with("//") {
            (text.find('\n').unwrap_or(text.len()), Self::Blank)
        } else if text.starts_with("/*") {
            (measure_comment(text), Self::Blank)
        } else if first.is_ascii_digit() {
            (
                end(|c| c.is_alphanumeric() || c == '_' || c == '.'),
                Self::Word,
            )
        } else if is_word(first) {
            (end(|c| c.is_alphanumeric() || c == '_'), Self::Word)
        } else {
            *rest = &text[first.len_utf8()..];
            return Some(Self::Mark(first));
        };
        let (taken, left) = text.split_at(length);
        *rest = left;
        Some(token(taken))
    }
}

/// Measures the comment that the text begins with, in bytes; comments may lie within one another.
fn measure_comment(text: &str) -> usize {
    let mut depth = 0;
    let mut at = 0;
    while at < text.len() {
        let here = &text.as_bytes()[at..];
        if here.starts_with(b"/*") {
            depth += 1;
            at += 2;
        } else if here.starts_with(b"*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += 1;
        }
    }
    text.len()
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
    /// Takes the next token; returns its depth.
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
            Token::Word(_) | Token::Blank(_) => {}
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
            Err(FilterError::Folder { line, .. }) => line,
            Err(error) => panic!("{error}"),
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
            refused_line(&"fn f(a: f32) -> f32 { return a; }\n".repeat(many)),
            None
        );
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
