//! Formats of storage images, given to those whose shader leaves them open.
//!
//! HLSL and Slang do not say in which format a texture is stored, and their compilers leave it out or guess. filter.toml knows.

use std::collections::BTreeMap;

use super::words::{Instruction, Place, UNIFORM_CONSTANT, Words, op};
use crate::Format;

/// Numbers of formats in SPIR-V.
const FORMATS: [(Format, u32); 11] = [
    (Format::Rgba32Float, 1),
    (Format::Rgba16Float, 2),
    (Format::R32Float, 3),
    (Format::Rgba8Unorm, 4),
    (Format::Rg32Float, 6),
    (Format::Rg16Float, 7),
    (Format::Rg11b10Ufloat, 8),
    (Format::R16Float, 9),
    (Format::Rgb10a2Unorm, 11),
    (Format::R8Unorm, 15),
    (Format::R32Uint, 33),
];

/// Operand of an image type that is 2 for storage images, and that of its format.
const SAMPLED: usize = 6;
const FORMAT: usize = 7;

/// Capabilities to read and to write images without a format, which nothing needs once all have one.
const WITHOUT_FORMAT: [u32; 2] = [55, 56];

/// Gives storage images the format that `choose` finds for their place and name: those without any, or `all`.
pub(super) fn give_formats(
    words: &mut Words,
    all: bool,
    choose: &dyn Fn(Place, &str) -> Option<Format>,
) {
    let images: BTreeMap<u32, Instruction> = (words.instructions.iter())
        .filter(|it| it.opcode == op::TYPE_IMAGE && it.operands.get(SAMPLED) == Some(&2))
        .map(|it| (it.operands[0], it.clone()))
        .collect();
    let pointers: BTreeMap<u32, u32> = (words.all(op::TYPE_POINTER))
        .filter(|[_, class, image]| *class == UNIFORM_CONSTANT && images.contains_key(image))
        .map(|[pointer, _, image]| (pointer, image))
        .collect();
    let (names, places) = (words.find_names(), words.find_places());
    // Image type and pointer of each variable with a format of its own.
    let mut typed: BTreeMap<u32, (Instruction, u32)> = BTreeMap::new();
    let variables: Vec<[u32; 2]> = words.all(op::VARIABLE).collect();
    for [pointer, variable] in variables {
        let Some(image) = pointers.get(&pointer) else {
            continue;
        };
        let name = names.get(&variable).map_or("", String::as_str);
        let place = places.get(&variable).copied();
        let chosen = place.and_then(|place| choose(place, name));
        let number = FORMATS.iter().find(|(known, _)| Some(*known) == chosen);
        let current = images[image].operands.get(FORMAT);
        let is_open = current.is_some_and(|current| all || *current == 0);
        if let (Some((_, number)), true) = (number, is_open) {
            let mut ty = images[image].clone();
            ty.operands[0] = words.new_id();
            ty.operands[FORMAT] = *number;
            typed.insert(variable, (ty, words.new_id()));
        }
    }
    let mut instructions = Vec::with_capacity(words.instructions.len());
    for mut instruction in std::mem::take(&mut words.instructions) {
        let needs = instruction.operands.first();
        if instruction.opcode == op::CAPABILITY
            && needs.is_some_and(|it| WITHOUT_FORMAT.contains(it))
        {
            continue;
        }
        match (instruction.opcode, instruction.first::<3>()) {
            (op::VARIABLE, Some([_, variable, _])) if typed.contains_key(&variable) => {
                let (image, pointer) = &typed[&variable];
                let to_image = [*pointer, UNIFORM_CONSTANT, image.operands[0]];
                instructions.push(image.clone());
                instructions.push(Instruction::new(op::TYPE_POINTER, to_image));
                instruction.operands[0] = *pointer;
            }
            (op::LOAD, Some([_, _, variable])) if typed.contains_key(&variable) => {
                instruction.operands[0] = typed[&variable].0.operands[0];
            }
            // The type may be left without a variable; naga reads it all the same.
            (op::TYPE_IMAGE, _) if images.contains_key(&instruction.operands[0]) => {
                if let Some(format @ 0) = instruction.operands.get_mut(FORMAT) {
                    *format = FORMATS[0].1;
                }
            }
            _ => {}
        }
        instructions.push(instruction);
    }
    words.instructions = instructions;
}
