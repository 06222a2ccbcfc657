//! Changes of text: lines, words, numbers, brackets.

use std::ops::Range;

use super::Source;
use crate::random::Random;
use crate::tokens::{NUMBERS, TEXTS};

type Change = fn(&mut Vec<u8>, &Source, &mut Random);

/// Changes. Numbers, texts and words of the format stand in the list more often.
const CHANGES: [Change; 16] = [
    change_number,
    change_number,
    change_number,
    change_quoted,
    change_quoted,
    insert_token,
    insert_token,
    insert_line_token,
    change_word,
    change_word,
    repeat_line,
    remove_line,
    swap_lines,
    borrow_line,
    nest,
    change_bracket,
];

/// Brackets that can be nested.
const BRACKETS: [(&str, &str); 7] = [
    ("[", "]"),
    ("{", "}"),
    ("(", ")"),
    ("{ a = ", " }"),
    ("{\"a\":", "}"),
    ("[[", "]]"),
    ("{ ", " }"),
];

/// Applies a random change.
pub fn change(input: &mut Vec<u8>, source: &Source, random: &mut Random) {
    random.pick(&CHANGES)(input, source, random);
}

/// Replaces a number.
fn change_number(input: &mut Vec<u8>, source: &Source, random: &mut Random) {
    let is_number = |word: &[u8]| matches!(word.first(), Some(b'0'..=b'9' | b'-' | b'.'));
    let numbers: Vec<Range<usize>> = (find_words(input).into_iter())
        .filter(|range| is_number(&input[range.clone()]))
        .collect();
    if numbers.is_empty() {
        return insert_token(input, source, random);
    }
    let range = random.pick(&numbers).clone();
    let new = match random.below(4) {
        0 => format!("{}", random.next() as i64 as f64 / (1_u64 << 60) as f64),
        1 => format!("{}", random.magnitude(1 << 31)),
        _ => (*random.pick(&NUMBERS)).to_owned(),
    };
    input.splice(range, new.into_bytes());
}

/// Replaces a text between quotes.
fn change_quoted(input: &mut Vec<u8>, source: &Source, random: &mut Random) {
    let quotes: Vec<usize> = (0..input.len()).filter(|at| input[*at] == b'"').collect();
    if quotes.len() < 2 {
        return change_word(input, source, random);
    }
    let first = random.below(quotes.len() - 1);
    let range = quotes[first] + 1..quotes[first + 1];
    let new = match random.below(8) {
        0 => "x".repeat(random.magnitude(20_000)),
        1 => {
            let other = random.below(quotes.len() - 1);
            let other = quotes[other] + 1..quotes[other + 1];
            String::from_utf8_lossy(&input[other]).into_owned()
        }
        _ => (*random.pick(&TEXTS)).to_owned(),
    };
    input.splice(range, new.into_bytes());
}

/// Inserts a word of the format anywhere.
fn insert_token(input: &mut Vec<u8>, source: &Source, random: &mut Random) {
    let at = match random.once_in(2) {
        true => random.below(input.len() + 1),
        false => random.pick(&find_words(input)).start,
    };
    let token = some_token(source, random);
    input.splice(at..at, token.bytes());
}

/// Inserts a word of the format before a line.
fn insert_line_token(input: &mut Vec<u8>, source: &Source, random: &mut Random) {
    let at = random.pick(&find_lines(input)).start;
    let token = some_token(source, random);
    input.splice(at..at, token.bytes());
}

/// Replaces a word.
fn change_word(input: &mut Vec<u8>, source: &Source, random: &mut Random) {
    let words = find_words(input);
    let range = random.pick(&words).clone();
    let new = match random.once_in(2) {
        true => some_token(source, random).trim_end().as_bytes().to_vec(),
        false => input[random.pick(&words).clone()].to_vec(),
    };
    input.splice(range, new);
}

fn repeat_line(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    let range = random.pick(&find_lines(input)).clone();
    let line = input[range.clone()].to_vec();
    let count = random.magnitude(2_000).min(1 + 100_000 / line.len().max(1));
    input.splice(range.end..range.end, line.repeat(count));
}

fn remove_line(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    let range = random.pick(&find_lines(input)).clone();
    input.drain(range);
}

fn swap_lines(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    let lines = find_lines(input);
    let (from, to) = (random.pick(&lines).clone(), random.pick(&lines).start);
    let line = input[from.clone()].to_vec();
    input.splice(to..to, line);
}

fn borrow_line(input: &mut Vec<u8>, source: &Source, random: &mut Random) {
    let line = random.pick(&find_lines(source.other)).clone();
    let at = random.pick(&find_lines(input)).start;
    input.splice(at..at, source.other[line].to_vec());
}

/// Nests brackets around a word.
fn nest(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    let range = random.pick(&find_words(input)).clone();
    let (open, close) = *random.pick(&BRACKETS);
    let depth = random.magnitude(20_000);
    let inner = input[range.clone()].to_vec();
    let mut nested = open.repeat(depth).into_bytes();
    nested.extend(inner);
    if !random.once_in(4) {
        nested.extend(close.repeat(depth).bytes());
    }
    input.splice(range, nested);
}

/// Removes or doubles a bracket or comma.
fn change_bracket(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    let marks = b"[]{}(),:=\"'\n";
    let places: Vec<usize> = (0..input.len())
        .filter(|at| marks.contains(&input[*at]))
        .collect();
    if places.is_empty() {
        return;
    }
    let at = *random.pick(&places);
    match random.once_in(2) {
        true => drop(input.remove(at)),
        false => input.insert(at, input[at]),
    }
}

fn some_token<'a>(source: &Source<'a>, random: &mut Random) -> &'a str {
    match source.tokens.is_empty() || random.once_in(6) {
        true => *random.pick(&TEXTS),
        false => *random.pick(source.tokens),
    }
}

/// Finds words and numbers. Without any, returns an empty range at the end.
fn find_words(input: &[u8]) -> Vec<Range<usize>> {
    let is_part = |byte: u8| byte.is_ascii_alphanumeric() || b"_-.+".contains(&byte);
    let mut words = Vec::new();
    let mut start = None;
    for (at, byte) in input.iter().enumerate() {
        match (start, is_part(*byte)) {
            (None, true) => start = Some(at),
            (Some(from), false) => {
                words.push(from..at);
                start = None;
            }
            _ => {}
        }
    }
    words.extend(start.map(|from| from..input.len()));
    if words.is_empty() {
        words.push(input.len()..input.len());
    }
    words
}

/// Finds lines with their ends. Without any, returns an empty range.
fn find_lines(input: &[u8]) -> Vec<Range<usize>> {
    let mut start = 0;
    let mut lines: Vec<Range<usize>> = (input.split_inclusive(|byte| *byte == b'\n'))
        .map(|line| {
            let range = start..start + line.len();
            start = range.end;
            range
        })
        .collect();
    if lines.is_empty() {
        lines.push(0..0);
    }
    lines
}
