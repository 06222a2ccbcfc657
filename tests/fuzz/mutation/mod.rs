//! Changes that turn inputs into other inputs.

mod bytes;
mod exr;
mod png;
mod spirv;
mod text;

use fastrand::Rng;

use crate::dictionary::words;
use crate::place::Place;
use crate::target::{Shape, Target};

/// Longest generated input.
const MAX_LENGTH: usize = 400_000;

/// Material for changes.
pub struct Source<'a> {
    /// Words of the target.
    words: &'static [String],
    /// Another input.
    other: &'a [u8],
}

/// Changes one of the inputs, once or a few times.
pub fn mutate(target: &Target, place: &Place, seeds: &[&[u8]], random: &mut Rng) -> Vec<u8> {
    let mut input = seeds[random.usize(..seeds.len())].to_vec();
    let source = Source {
        words: match target.shape {
            Shape::Text(name) => words(name),
            Shape::CommandLine => words("command_line"),
            _ => words("texts"),
        },
        other: seeds[random.usize(..seeds.len())],
    };
    // Half of the files get wrong bytes, too.
    let whole = random.bool();
    for _ in 0..magnitude(4, random) {
        let format = match target.shape {
            Shape::Text(_) => match random.u8(..8) {
                0 => &bytes::FORMAT,
                1 | 2 => &text::LINES,
                _ => &text::WORDS,
            },
            Shape::CommandLine => &text::COMMAND_LINE,
            Shape::Picture if whole && input.starts_with(png::SIGNATURE) => &png::FORMAT,
            Shape::Picture if whole && input.starts_with(exr::MAGIC) => {
                exr::change(&mut input, place, random);
                continue;
            }
            Shape::Spirv if whole => &spirv::FORMAT,
            Shape::Bytes | Shape::Picture | Shape::Spirv => &bytes::FORMAT,
        };
        format.change(&mut input, &source, random);
        input.truncate(MAX_LENGTH);
    }
    input
}

/// Draws a number from 1 to `most`; small numbers are as likely as large ones.
fn magnitude(most: usize, random: &mut Rng) -> usize {
    let bits = 1 + random.u32(..=most.ilog2());
    (1 + random.usize(..1 << bits)).min(most)
}

/// How inputs of one format are cut, changed and joined.
pub struct Format {
    /// Bytes before the first piece.
    pub header: usize,
    /// Cuts the rest after the header.
    pub cut: fn(&[u8], &mut Rng) -> Vec<Vec<u8>>,
    /// Appends a piece, with its length and checksum.
    pub write: fn(&mut Vec<u8>, &[u8]),
    /// Changes the content of one of the pieces; there is at least one.
    pub edit: fn(&mut Vec<Vec<u8>>, &Source, &mut Rng),
    /// Number of changes in eight that add, remove or move pieces; the others edit one.
    pub moves: u8,
}

/// Most bytes that a repetition adds.
const MAX_REPEATED: usize = 100_000;

impl Format {
    /// Changes an input.
    pub fn change(&self, input: &mut Vec<u8>, source: &Source, random: &mut Rng) {
        let head = self.header.min(input.len());
        let mut pieces = (self.cut)(&input[head..], random);
        if pieces.is_empty() {
            pieces.push(Vec::new());
        }
        match random.u8(..8) < self.moves {
            true => {
                let other = source.other.get(self.header..).unwrap_or_default();
                change_list(&mut pieces, &(self.cut)(other, random), random);
            }
            false => (self.edit)(&mut pieces, source, random),
        }
        input.truncate(head);
        for piece in &pieces {
            (self.write)(input, piece);
        }
    }
}

/// Removes, repeats, moves, borrows or cuts off pieces.
fn change_list(pieces: &mut Vec<Vec<u8>>, others: &[Vec<u8>], random: &mut Rng) {
    let (at, to) = (random.usize(..pieces.len()), random.usize(..pieces.len()));
    match random.u8(..6) {
        0 => drop(pieces.remove(at)),
        1 => {
            let piece = pieces[at].clone();
            let count = magnitude(2_000, random).min(1 + MAX_REPEATED / piece.len().max(1));
            pieces.splice(at..at, vec![piece; count]);
        }
        2 => pieces.insert(to, pieces[at].clone()),
        3 => pieces.swap(at, to),
        4 if !others.is_empty() => pieces.insert(to, others[random.usize(..others.len())].clone()),
        _ => {
            pieces.truncate(at);
            // Half of the inputs continue like another.
            if random.bool() {
                let from = random.usize(..=others.len());
                pieces.extend_from_slice(&others[from..]);
            }
        }
    }
}
