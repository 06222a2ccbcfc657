//! Changes of PNG files: chunks with right checksums and wrong content.

use flate2::Crc;

use super::{Source, bytes};
use crate::random::Random;

const SIGNATURE: usize = 8;

/// A chunk: its type and content.
type Chunk = ([u8; 4], Vec<u8>);

/// Changes, doubles, moves or removes a chunk.
pub fn change(input: &mut Vec<u8>, random: &mut Random) {
    let mut chunks = read_chunks(input);
    if chunks.is_empty() {
        return;
    }
    let at = random.below(chunks.len());
    match random.below(6) {
        0 => drop(chunks.remove(at)),
        1 => chunks.insert(at, chunks[at].clone()),
        2 => chunks.swap(at, 0),
        3 => change_header(&mut chunks[0].1, random),
        _ => {
            let none = Source {
                tokens: &[],
                other: &[],
            };
            bytes::change(&mut chunks[at].1, &none, random);
        }
    }
    input.truncate(SIGNATURE);
    for (name, content) in &chunks {
        push(input, *name, content);
    }
}

/// Appends a chunk with its length and checksum.
pub fn push(file: &mut Vec<u8>, name: [u8; 4], content: &[u8]) {
    file.extend((content.len() as u32).to_be_bytes());
    let mut crc = Crc::new();
    crc.update(&name);
    crc.update(content);
    file.extend(name);
    file.extend(content);
    file.extend(crc.sum().to_be_bytes());
}

/// Changes the size, depth, kind of colour or interlacing.
fn change_header(content: &mut [u8], random: &mut Random) {
    if content.len() < 13 {
        return;
    }
    const SIDES: [u32; 7] = [0, 1, 3, 65_535, 100_000, 0x7FFF_FFFF, u32::MAX];
    match random.below(5) {
        0 => content[..4].copy_from_slice(&random.pick(&SIDES).to_be_bytes()),
        1 => content[4..8].copy_from_slice(&random.pick(&SIDES).to_be_bytes()),
        2 => content[8] = *random.pick(&[1, 2, 4, 8, 16, 32]),
        3 => content[9] = *random.pick(&[0, 2, 3, 4, 6, 7]),
        _ => content[12] ^= 1,
    }
}

fn read_chunks(input: &[u8]) -> Vec<Chunk> {
    let mut chunks = Vec::new();
    let mut rest = input.get(SIGNATURE..).unwrap_or_default();
    while let [a, b, c, d, name @ ..] = rest {
        let length = u32::from_be_bytes([*a, *b, *c, *d]) as usize;
        let (Some(name), Some(content)) = (name.first_chunk::<4>(), rest.get(8..8 + length)) else {
            break;
        };
        chunks.push((*name, content.to_vec()));
        rest = rest.get(12 + length..).unwrap_or_default();
    }
    chunks
}
