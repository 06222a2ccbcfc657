//! Changes that turn inputs into other inputs.

#![expect(
    clippy::explicit_auto_deref,
    reason = "types of picks are inferred from it"
)]

mod bytes;
mod exr;
mod png;
mod spirv;
mod text;
mod words;

pub use png::push as push_chunk;

use crate::place::Place;
use crate::random::Random;
use crate::target::{Shape, Target};

/// Longest input that is made.
const LONGEST: usize = 400_000;

/// First bytes of PNG files.
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";
const EXR: &[u8] = b"\x76\x2F\x31\x01";

/// Material that changes are made with.
pub struct Source<'a> {
    /// Words of the target.
    pub tokens: &'static [&'static str],
    /// Another input.
    pub other: &'a [u8],
}

/// Changes one of the inputs, once or a few times.
pub fn mutate(target: &Target, place: &Place, seeds: &[&[u8]], random: &mut Random) -> Vec<u8> {
    let mut input = random.pick(seeds).to_vec();
    let source = Source {
        tokens: target.tokens,
        other: *random.pick(seeds),
    };
    // Half of the files get wrong bytes, too.
    let whole = !random.once_in(2);
    for _ in 0..random.magnitude(4) {
        match target.shape {
            Shape::Text if random.once_in(8) => bytes::change(&mut input, &source, random),
            Shape::Text => text::change(&mut input, &source, random),
            Shape::Words => words::change(&mut input, &source, random),
            Shape::Picture if whole && input.starts_with(PNG) => png::change(&mut input, random),
            Shape::Picture if whole && input.starts_with(EXR) => {
                exr::change(&mut input, place, random);
            }
            Shape::Spirv if whole => spirv::change(&mut input, source.other, random),
            Shape::Bytes | Shape::Picture | Shape::Spirv => {
                bytes::change(&mut input, &source, random)
            }
        }
        input.truncate(LONGEST);
    }
    input
}
