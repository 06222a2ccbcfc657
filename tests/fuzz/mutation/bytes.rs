//! Changes of bytes, whatever their meaning.

use fastrand::Rng;

use super::Format;
use super::magnitude;

/// Three pieces with random ends.
pub static FORMAT: Format = Format {
    header: 0,
    cut: |input, random| {
        let (first, rest) = input.split_at(random.usize(..=input.len()));
        let length = magnitude(input.len().max(1), random);
        let (second, third) = rest.split_at(length.min(rest.len()));
        [first, second, third].map(<[u8]>::to_vec).into()
    },
    write: |input, piece| input.extend(piece),
    edit: |pieces, _, random| {
        let mut whole = pieces.concat();
        edit(&mut whole, random);
        *pieces = vec![whole];
    },
    moves: 4,
};

/// Ends of lines and texts, and bytes at limits.
const LIMITS: [u8; 10] = [0, 1, 9, 10, 13, 27, 34, 127, 128, 255];

/// Flips a bit, writes a byte or number at a limit, or inserts equal bytes.
pub fn edit(bytes: &mut Vec<u8>, random: &mut Rng) {
    let kind = random.u8(..4);
    let end = match kind == 2 && random.bool() {
        // Lengths are in headers.
        true => bytes.len().min(64),
        false => bytes.len(),
    };
    let at = random.usize(..=end);
    let changed = &mut bytes[at..];
    match (kind, changed.first_mut()) {
        (0, Some(byte)) => *byte ^= 1 << random.u32(..8),
        (1, Some(byte)) => *byte = random.choice(LIMITS).expect("a list"),
        (2, Some(_)) => {
            let number = make_number(random);
            let number = match random.bool() {
                true => number.to_le_bytes(),
                false => number.to_be_bytes(),
            };
            let count = changed.len().min(4);
            changed[..count].copy_from_slice(&number[..count]);
        }
        _ => {
            let count = magnitude(64, random);
            bytes.splice(at..at, vec![random.u8(..); count]);
        }
    }
}

/// Makes a length or number at a limit.
pub fn make_number(random: &mut Rng) -> u32 {
    match random.u8(..4) {
        0 => random.u32(..8),
        1 => f32::INFINITY.to_bits() | random.u32(..2) << 22,
        2 => 1 << random.u32(..32),
        _ => u32::MAX >> random.u32(..32),
    }
}
