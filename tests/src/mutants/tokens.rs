//! Tokens of WGSL: words, numbers and signs.

/// A token that a mutant may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Token<'t> {
    /// Kind of the token.
    pub kind: Kind,
    /// Its text.
    pub text: &'t str,
    /// Its first byte.
    pub start: usize,
}

/// Kind of a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Name or keyword.
    Word,
    /// Literal number.
    Number,
    /// Operator or punctuation.
    Sign,
}

/// Signs of more than one character, the longest first.
const LONG_SIGNS: [&str; 20] = [
    "<<=", ">>=", "++", "--", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "==", "!=", "<=",
    ">=", "&&", "||", "->", "<<",
];

/// Splits a text into its tokens. Leaves out comments, attributes, and lists such as `<f32>`, which begin directly after a word.
pub fn split(text: &str) -> Vec<Token<'_>> {
    let mut tokens: Vec<Token> = Vec::new();
    let mut start = 0;
    while let Some(first) = text[start..].chars().next() {
        let rest = &text[start..];
        let behind_word = tokens
            .last()
            .is_some_and(|last| last.kind == Kind::Word && last.start + last.text.len() == start);
        let skipped = match first {
            _ if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            _ if rest.starts_with("/*") => rest.find("*/").map_or(rest.len(), |end| end + 2),
            '@' => attribute_length(rest),
            '<' if behind_word => bracketed_length(rest, ['<', '>']),
            _ if first.is_whitespace() => first.len_utf8(),
            _ => 0,
        };
        if skipped > 0 {
            start += skipped;
            continue;
        }
        let (kind, length) = match first {
            '0'..='9' => (Kind::Number, number_length(rest)),
            _ if is_of_word(first) => (Kind::Word, word_length(rest)),
            _ => (Kind::Sign, sign_length(rest)),
        };
        let text = &rest[..length];
        tokens.push(Token { kind, text, start });
        start += length;
    }
    tokens
}

fn is_of_word(sign: char) -> bool {
    sign.is_alphanumeric() || sign == '_'
}

fn word_length(rest: &str) -> usize {
    rest.find(|sign| !is_of_word(sign)).unwrap_or(rest.len())
}

/// Measures a number with its suffix and exponent: `1e-5`, `0.5f`, `0xffu`.
fn number_length(rest: &str) -> usize {
    let is_hex = rest.starts_with("0x");
    let mut before = ' ';
    let end = rest.find(|sign: char| {
        let is_exponent = matches!(sign, '+' | '-') && matches!(before, 'e' | 'E') && !is_hex;
        before = sign;
        !(sign.is_ascii_alphanumeric() || sign == '.' || is_exponent)
    });
    end.unwrap_or(rest.len())
}

fn sign_length(rest: &str) -> usize {
    let long = LONG_SIGNS.iter().find(|sign| rest.starts_with(**sign));
    match long {
        Some(sign) => sign.len(),
        None => rest.chars().next().map_or(0, char::len_utf8),
    }
}

/// Measures an attribute with its arguments: `@binding(1)`.
fn attribute_length(rest: &str) -> usize {
    let name = 1 + word_length(&rest[1..]);
    match rest[name..].starts_with('(') {
        true => name + bracketed_length(&rest[name..], ['(', ')']),
        false => name,
    }
}

/// Measures a text that begins with an opening bracket, up to its closing bracket.
fn bracketed_length(rest: &str, [open, close]: [char; 2]) -> usize {
    let mut depth = 0;
    let end = rest.find(|sign| {
        depth += i32::from(sign == open) - i32::from(sign == close);
        depth == 0
    });
    end.map_or(rest.len(), |end| end + close.len_utf8())
}
