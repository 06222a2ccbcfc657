//! Changes of text: lines, words, numbers, brackets.

use fastrand::Rng;

use super::Format;
use super::{Source, magnitude};
use crate::dictionary::words;

/// Words of a command line, each in a line.
pub static COMMAND_LINE: Format = Format { moves: 3, ..LINES };

/// Lines with their ends.
pub const LINES: Format = Format {
    header: 0,
    cut: |input, _| {
        let lines = input.split_inclusive(|byte| *byte == b'\n');
        lines.map(<[u8]>::to_vec).collect()
    },
    write: |input, line| {
        input.extend(line);
        if !line.ends_with(b"\n") {
            input.push(b'\n');
        }
    },
    edit: |lines, source, random| {
        let at = random.usize(..lines.len());
        let line = pick_word(source, random).into();
        match random.bool() {
            true => lines.insert(at, line),
            false => lines[at] = line,
        }
    },
    moves: 7,
};

/// Words, and every other byte alone. In half of the cases a text with its quotes is one piece.
pub static WORDS: Format = Format {
    header: 0,
    cut: |input, random| cut_words(input, random.bool()),
    write: |input, word| input.extend(word),
    edit: edit_words,
    moves: 1,
};

/// Pairs of nestable brackets: opening and closing text.
const BRACKETS: [[&str; 2]; 7] = [
    ["[", "]"],
    ["{", "}"],
    ["(", ")"],
    ["{ a = ", " }"],
    ["{\"a\":", "}"],
    ["[[", "]]"],
    ["{ ", " }"],
];

fn is_part_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || b"_-.+".contains(&byte)
}

fn cut_words(mut rest: &[u8], has_texts: bool) -> Vec<Vec<u8>> {
    let mut words = Vec::new();
    while let [first, more @ ..] = rest {
        let length = match *first {
            b'"' if has_texts => {
                let end = more.iter().position(|byte| *byte == b'"');
                end.map_or(1, |at| at + 2)
            }
            _ => {
                let word = rest.iter().take_while(|byte| is_part_of_word(**byte));
                word.count().max(1)
            }
        };
        let (word, after) = rest.split_at(length);
        words.push(word.to_vec());
        rest = after;
    }
    words
}

/// Changes a number, a text, a word or a bracket: each kind has a fixed share, whatever its count.
fn edit_words(pieces: &mut Vec<Vec<u8>>, source: &Source, random: &mut Rng) {
    let kind = random.u8(..16);
    let suits = |word: &[u8]| match (kind, word.first()) {
        (0..5, first) => matches!(first, Some(b'0'..=b'9' | b'-' | b'.')),
        (5..9, first) => first == Some(&b'"') && word.len() > 1,
        (9..13, first) => first.is_some_and(|byte| is_part_of_word(*byte)),
        (13, first) => first.is_some_and(|byte| b"[]{}(),:=\"'\n".contains(byte)),
        _ => true,
    };
    let suited: Vec<usize> = (0..pieces.len()).filter(|at| suits(&pieces[*at])).collect();
    let Some(at) = random.choice(suited) else {
        let at = random.usize(..pieces.len());
        return pieces.insert(at, pick_word(source, random).into());
    };
    let old = &pieces[at];
    pieces[at] = match kind {
        0..5 => make_number(random).into(),
        5..9 => format!("\"{}\"", make_text(random)).into(),
        9..12 if random.bool() => pick_word(source, random).trim_end().into(),
        9..12 => pieces[random.usize(..pieces.len())].clone(),
        12 => nest(old, random),
        13 if random.bool() => Vec::new(),
        13 => old.repeat(2),
        _ => [pick_word(source, random).as_bytes(), old].concat(),
    };
}

fn make_number(random: &mut Rng) -> String {
    match random.u8(..4) {
        0 => ((random.f64() - 0.5) * 16.0).to_string(),
        1 => magnitude(1 << 31, random).to_string(),
        _ => pick_number(random).to_owned(),
    }
}

/// Picks a number at or beyond a limit.
pub fn pick_number(random: &mut Rng) -> &'static str {
    random.choice(words("numbers")).expect("it is a list")
}

/// Makes the content of a text between quotes.
pub fn make_text(random: &mut Rng) -> String {
    match random.u8(..8) {
        0 => "x".repeat(magnitude(20_000, random)),
        _ => random.choice(words("texts")).expect("a list").clone(),
    }
}

/// Nests brackets around a word; some stay open.
fn nest(word: &[u8], random: &mut Rng) -> Vec<u8> {
    let [open, close] = random.choice(BRACKETS).expect("a list");
    let depth = magnitude(20_000, random);
    let closed = if random.u8(..4) == 0 { 0 } else { depth };
    [
        open.repeat(depth).as_bytes(),
        word,
        close.repeat(closed).as_bytes(),
    ]
    .concat()
}

fn pick_word(source: &Source, random: &mut Rng) -> &'static str {
    let list = match random.u8(..6) {
        0 => words("texts"),
        _ => source.words,
    };
    random.choice(list).expect("a dictionary has words")
}
