//! Changes that turn inputs into other inputs.

mod bytes;
mod exr;
mod pieces;
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
