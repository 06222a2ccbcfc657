//! Mip level of texels that are fetched: `texture[pixel]` of Slang names none, and naga wants one.

use super::words::{Instruction, Words, op};

/// Operand that says that a level follows.
pub(super) const LOD: u32 = 2;

/// Fetches texels from level 0 where a module names none.
pub(super) fn name_levels(words: &mut Words) {
    let is_bare = |it: &Instruction| it.opcode == op::IMAGE_FETCH && it.operands.len() == 4;
    if !words.instructions.iter().any(is_bare) {
        return;
    }
    let signed = (words.all(op::TYPE_INT)).find(|[_, width, signed]| [*width, *signed] == [32, 1]);
    let integer = signed.map_or_else(|| words.new_id(), |[id, ..]| id);
    let zero = words.new_id();
    let mut declared = false;
    let mut instructions = Vec::with_capacity(words.instructions.len());
    for mut instruction in std::mem::take(&mut words.instructions) {
        if instruction.opcode == op::FUNCTION && !std::mem::replace(&mut declared, true) {
            if signed.is_none() {
                instructions.push(Instruction::new(op::TYPE_INT, [integer, 32, 1]));
            }
            instructions.push(Instruction::new(op::CONSTANT, [integer, zero, 0]));
        }
        if is_bare(&instruction) {
            instruction.operands.extend([LOD, zero]);
        }
        instructions.push(instruction);
    }
    words.instructions = instructions;
}
