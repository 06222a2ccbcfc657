//! Changes of SPIR-V modules: instructions of right lengths with wrong words.

use fastrand::Rng;

use super::Format;
use super::bytes::make_number;

/// Ids of a small module are below this.
const IDS: u32 = 200;

/// Instructions, each of whole words.
pub static FORMAT: Format = Format {
    header: 20,
    cut: |mut rest, _| {
        let mut instructions = Vec::new();
        while let [_, _, low, high, ..] = rest {
            let length = 4 * u16::from_le_bytes([*low, *high]).max(1) as usize;
            let (instruction, after) = rest.split_at(length.min(rest.len()));
            instructions.push(instruction.to_vec());
            rest = after;
        }
        instructions
    },
    write: |module, instruction| {
        let start = module.len();
        module.extend(instruction);
        let count = (instruction.len() / 4) as u16;
        if let Some(length) = module.get_mut(start + 2..start + 4) {
            length.copy_from_slice(&count.to_le_bytes());
        }
    },
    edit: |instructions, _, random| edit(instructions, random),
    moves: 4,
};

/// Changes an opcode or another word, or adds one.
fn edit(instructions: &mut [Vec<u8>], random: &mut Rng) {
    let at = random.usize(..instructions.len());
    let other = random.usize(..instructions.len());
    let opcode: Vec<u8> = instructions[other].iter().take(2).copied().collect();
    let instruction = &mut instructions[at];
    let count = instruction.len() / 4;
    match random.u8(..6) {
        0 if count > 0 => {
            instruction.splice(..2, opcode);
        }
        1 => instruction.extend(random.u32(..IDS).to_le_bytes()),
        kind if count > 1 => {
            let words = instruction.as_chunks_mut().0;
            let word = &mut words[random.usize(1..count)];
            let old = u32::from_le_bytes(*word);
            let new = match kind {
                2 => make_number(random),
                3 => old ^ 1 << random.u32(..32),
                _ => random.u32(..IDS),
            };
            *word = new.to_le_bytes();
        }
        _ => {}
    }
}
