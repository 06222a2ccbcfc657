//! Changes of SPIR-V modules: instructions of right lengths with wrong words.

use crate::random::Random;

/// Words of the header.
const HEADER: usize = 5;

/// Changes, doubles, moves or removes an instruction, or one of its words.
pub fn change(input: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    let (header, mut instructions) = read_instructions(input);
    let (_, others) = read_instructions(other);
    if instructions.is_empty() {
        return;
    }
    let at = random.below(instructions.len());
    let to = random.below(instructions.len());
    match random.below(8) {
        0 => drop(instructions.remove(at)),
        1 => instructions.insert(to, instructions[at].clone()),
        2 => instructions.swap(at, to),
        3 if !others.is_empty() => instructions.insert(to, random.pick(&others).clone()),
        4 => instructions[at][0] = instructions[to][0] & 0xffff,
        5 => instructions[at].push(random.below(200) as u32),
        _ => change_word(&mut instructions[at], random),
    }
    let words = instructions.into_iter().flat_map(|mut instruction| {
        instruction[0] = (instruction.len() as u32) << 16 | instruction[0] & 0xffff;
        instruction
    });
    *input = header
        .into_iter()
        .chain(words)
        .flat_map(u32::to_le_bytes)
        .collect();
}

/// Changes a word after the first; ids of a small module are below 200.
fn change_word(instruction: &mut [u32], random: &mut Random) {
    const NUMBERS: [u32; 6] = [0, 1, 2, 4, 0x7fff_ffff, u32::MAX];
    if instruction.len() > 1 {
        let at = 1 + random.below(instruction.len() - 1);
        instruction[at] = match random.below(4) {
            0 => *random.pick(&NUMBERS),
            1 => instruction[at] ^ (1 << random.below(32)),
            _ => random.below(200) as u32,
        };
    }
}

/// Reads the words of the header and of each whole instruction.
fn read_instructions(input: &[u8]) -> (Vec<u32>, Vec<Vec<u32>>) {
    let words: Vec<u32> = (input.chunks_exact(4))
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect();
    let (header, mut rest) = words.split_at(HEADER.min(words.len()));
    let mut instructions = Vec::new();
    while let Some(first) = rest.first() {
        let count = ((first >> 16) as usize).clamp(1, rest.len());
        instructions.push(rest[..count].to_vec());
        rest = &rest[count..];
    }
    (header.to_vec(), instructions)
}
