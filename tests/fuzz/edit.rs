//! Edits that make hostile inputs from sound ones.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// A change of an input, which is cut into pieces: words and signs of a text, four bytes of other
/// inputs.
#[derive(Clone, Debug)]
pub struct Edit {
    /// First piece.
    at: Index,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Removes this many pieces.
    Remove(usize),
    /// Repeats this many pieces.
    Repeat(usize),
    /// Replaces a piece by another one of the input.
    Borrow(Index),
    /// Replaces a piece by a word.
    Word(&'static str),
    /// Replaces a piece by bytes.
    Bytes(Vec<u8>),
    /// Ends the input.
    Cut,
}

/// Words and numbers at the borders of what programs expect.
#[rustfmt::skip]
const WORDS: [&str; 32] = [
    "", "0", "-1", "1", "-", "1e39", "-1e39", "1e309", "1e-46", "nan", "inf", "65536", "4294967296",
    "18446744073709551616", "true", "null", "\"", "\\", "[", "]", "{", "}", "[[", "\n", "=", "#",
    "../../new", "C:\\new", "a/b", "\u{0}", "\u{e9}", "\u{202e}",
];

/// Makes one to eight edits.
pub fn edits() -> impl Strategy<Value = Vec<Edit>> {
    let kind = prop_oneof![
        (1..20_usize).prop_map(Kind::Remove),
        (1..20_usize).prop_map(Kind::Repeat),
        any::<Index>().prop_map(Kind::Borrow),
        select(&WORDS[..]).prop_map(Kind::Word),
        vec(any::<u8>(), 1..5).prop_map(Kind::Bytes),
        Just(Kind::Cut),
    ];
    vec(
        (any::<Index>(), kind).prop_map(|(at, kind)| Edit { at, kind }),
        1..=8,
    )
}

/// Applies edits one after the other.
pub fn apply(input: &[u8], edits: &[Edit]) -> Vec<u8> {
    let mut input = input.to_vec();
    for edit in edits {
        let mut pieces = cut(&input);
        if pieces.is_empty() {
            pieces.push(b"");
        }
        let at = edit.at.index(pieces.len());
        let end = |count: &usize| pieces.len().min(at + count);
        match &edit.kind {
            Kind::Remove(count) => drop(pieces.drain(at..end(count))),
            Kind::Repeat(count) => {
                let repeated = pieces[at..end(count)].to_vec();
                pieces.splice(at..at, repeated);
            }
            Kind::Borrow(other) => pieces[at] = pieces[other.index(pieces.len())],
            Kind::Word(word) => pieces[at] = word.as_bytes(),
            Kind::Bytes(bytes) => pieces[at] = bytes,
            Kind::Cut => pieces.truncate(at),
        }
        input = pieces.concat();
    }
    input
}

fn cut(input: &[u8]) -> Vec<&[u8]> {
    if std::str::from_utf8(input).is_err() {
        return input.chunks(4).collect();
    }
    let is_word = |byte: u8| byte.is_ascii_alphanumeric() || b"._".contains(&byte);
    input.chunk_by(|a, b| is_word(*a) && is_word(*b)).collect()
}
