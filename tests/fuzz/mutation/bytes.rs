//! Changes of bytes, whatever they mean.

#![expect(clippy::ptr_arg, reason = "changes of all kinds stand in one table")]

use super::Source;
use crate::random::Random;

type Change = fn(&mut Vec<u8>, &Source, &mut Random);

const CHANGES: [Change; 8] = [
    flip,
    replace,
    write_number,
    insert,
    remove,
    repeat,
    cut,
    splice,
];

/// Applies a random change.
pub fn change(input: &mut Vec<u8>, source: &Source, random: &mut Random) {
    random.pick(&CHANGES)(input, source, random);
}

/// Picks a position in the input, or its end.
pub fn place(input: &[u8], random: &mut Random) -> usize {
    random.below(input.len() + 1)
}

/// Picks a piece of the input.
pub fn pick_piece(input: &[u8], random: &mut Random) -> std::ops::Range<usize> {
    let start = place(input, random);
    let length = random.magnitude(input.len().max(1));
    start..(start + length).min(input.len())
}

fn flip(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    if !input.is_empty() {
        let at = random.below(input.len());
        input[at] ^= 1 << random.below(8);
    }
}

fn replace(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    if !input.is_empty() {
        let at = random.below(input.len());
        input[at] = *random.pick(&[0, 1, 9, 10, 13, 27, 34, 127, 128, 255]);
    }
}

/// Writes two or four bytes that are a length or a number at a limit.
fn write_number(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    const NUMBERS: [u32; 12] = [
        0,
        1,
        0x7F,
        0xFF,
        0x7FFF,
        0xFFFF,
        0x00FF_FFFF,
        0x7FFF_FFFF,
        0x8000_0000,
        u32::MAX,
        0x7F80_0000,
        0x7FC0_0000,
    ];
    let number = *random.pick(&NUMBERS);
    let bytes = match random.once_in(2) {
        true => number.to_le_bytes(),
        false => number.to_be_bytes(),
    };
    let start = place(input, random);
    // Lengths lie in headers.
    let start = match random.once_in(2) {
        true => start.min(random.below(64)),
        false => start,
    };
    for (to, from) in input[start..].iter_mut().zip(bytes) {
        *to = from;
    }
}

fn insert(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    let at = place(input, random);
    let count = random.magnitude(64);
    let byte = random.next() as u8;
    input.splice(at..at, std::iter::repeat_n(byte, count));
}

fn remove(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    let piece = pick_piece(input, random);
    input.drain(piece);
}

fn repeat(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    let range = pick_piece(input, random);
    let piece = input[range.clone()].to_vec();
    let count = random.magnitude(64).min(1 + 100_000 / piece.len().max(1));
    input.splice(range.end..range.end, piece.repeat(count));
}

fn cut(input: &mut Vec<u8>, _: &Source, random: &mut Random) {
    let end = place(input, random);
    input.truncate(end);
}

/// Continues as another input does.
fn splice(input: &mut Vec<u8>, source: &Source, random: &mut Random) {
    let end = place(input, random);
    input.truncate(end);
    let start = match random.once_in(2) {
        true => end.min(source.other.len()),
        false => place(source.other, random),
    };
    input.extend_from_slice(&source.other[start..]);
}
