//! Access of kernels to storage images, narrowed to what they do.
//!
//! GLSL often leaves `readonly` and `writeonly` out, and WebGPU lets few formats be read and written at once. An image that is only
//! written is declared so. One that is only read becomes a sampled texture, which every format can be. One that is both becomes two
//! variables first: what is read is what it held before the pass.

use std::collections::{BTreeMap, BTreeSet};

use super::levels::LOD;
use super::words::{Instruction, Place, UNIFORM_CONSTANT, Words, decoration, op};

/// Uses of one storage image.
#[derive(Clone, Copy, Default)]
struct Uses {
    reads: bool,
    writes: bool,
    /// Uses that the narrowing does not understand, such as passing it to a function.
    others: bool,
}

/// Narrows the access to every storage image.
pub(super) fn narrow_storage_access(words: &mut Words) {
    let (storage_types, variables) = find_images(words);
    let uses = find_uses(words, &variables);
    let written = |uses: &Uses| uses.writes && !uses.reads && !uses.others;
    let read = |uses: &Uses| uses.reads && !uses.writes && !uses.others;
    let only = |is: &dyn Fn(&Uses) -> bool| -> BTreeSet<u32> {
        let chosen = uses.iter().filter(|(_, uses)| is(uses));
        chosen.map(|(variable, _)| *variable).collect()
    };
    declare_written(words, &only(&written));
    sample_read(words, &only(&read), &variables, &storage_types);
}

/// Finds the types of storage images, and the variables of these types.
fn find_images(words: &Words) -> (BTreeMap<u32, Instruction>, BTreeMap<u32, u32>) {
    let storage_types: BTreeMap<u32, Instruction> = (words.instructions.iter())
        .filter(|it| it.opcode == op::TYPE_IMAGE && it.operands.get(6) == Some(&2))
        .map(|it| (it.operands[0], it.clone()))
        .collect();
    let pointers: BTreeMap<u32, u32> = (words.all(op::TYPE_POINTER))
        .filter(|[_, class, image]| *class == UNIFORM_CONSTANT && storage_types.contains_key(image))
        .map(|[pointer, _, image]| (pointer, image))
        .collect();
    // Image types of the variables.
    let variables: BTreeMap<u32, u32> = (words.all(op::VARIABLE))
        .filter_map(|[pointer, variable]| Some((variable, *pointers.get(&pointer)?)))
        .collect();
    (storage_types, variables)
}

/// Splits images that a kernel both reads and writes in two variables. Returns the places of those that are read, each with the
/// place of the one that is written.
pub(super) fn split_images(words: &mut Words) -> BTreeMap<Place, Place> {
    let (_, variables) = find_images(words);
    let uses = find_uses(words, &variables);
    let read: BTreeSet<u32> = (words.all(op::IMAGE_READ))
        .map(|[_, _, image]| image)
        .collect();
    // A load that serves both stays whole.
    let shared: BTreeSet<u32> = (words.all(op::IMAGE_WRITE))
        .map(|[image]| image)
        .filter(|image| read.contains(image))
        .collect();
    let shared: BTreeSet<u32> = (words.all(op::LOAD))
        .filter(|[_, image, _]| shared.contains(image))
        .map(|[_, _, variable]| variable)
        .collect();
    let both: Vec<u32> = (uses.into_iter())
        .filter(|(_, uses)| uses.reads && uses.writes && !uses.others)
        .map(|(variable, _)| variable)
        .filter(|variable| !shared.contains(variable))
        .collect();
    let written = words.find_places();
    let free = words.find_free_places(&both);
    let twins: BTreeMap<u32, u32> = free
        .keys()
        .map(|variable| (*variable, words.new_id()))
        .collect();
    let mut instructions = Vec::with_capacity(words.instructions.len());
    for mut instruction in std::mem::take(&mut words.instructions) {
        let twin = (instruction.operands.first()).and_then(|named| twins.get(named));
        if let (op::NAME, Some(twin)) = (instruction.opcode, twin) {
            let mut copy = instruction.clone();
            copy.operands[0] = *twin;
            instructions.push(copy);
        }
        match (instruction.opcode, instruction.first::<3>()) {
            (op::VARIABLE, Some([pointer, variable, class])) if twins.contains_key(&variable) => {
                let twin = [pointer, twins[&variable], class];
                instructions.push(Instruction::new(op::VARIABLE, twin));
            }
            (op::DECORATE, Some([variable, kind, value])) if twins.contains_key(&variable) => {
                let value = match kind {
                    decoration::BINDING => free[&variable].1,
                    _ => value,
                };
                instructions.push(Instruction::new(
                    op::DECORATE,
                    [twins[&variable], kind, value],
                ));
            }
            (op::LOAD, Some([_, image, variable]))
                if twins.contains_key(&variable) && read.contains(&image) =>
            {
                instruction.operands[2] = twins[&variable];
            }
            _ => {}
        }
        instructions.push(instruction);
    }
    words.instructions = instructions;
    (free.into_iter())
        .map(|(variable, read)| (read, written[&variable]))
        .collect()
}

/// Finds what a module does with each variable.
fn find_uses(words: &Words, variables: &BTreeMap<u32, u32>) -> BTreeMap<u32, Uses> {
    let mut uses: BTreeMap<u32, Uses> = variables.keys().map(|id| (*id, Uses::default())).collect();
    // Variable of each loaded image.
    let mut loaded = BTreeMap::new();
    for instruction in &words.instructions {
        let operands = &instruction.operands;
        match (instruction.opcode, &operands[..]) {
            (op::LOAD, [_, result, pointer, ..]) if variables.contains_key(pointer) => {
                loaded.insert(*result, *pointer);
            }
            (op::IMAGE_READ, [_, _, image, _, rest @ ..]) if loaded.contains_key(image) => {
                let found = uses.entry(loaded[image]).or_default();
                found.reads = true;
                found.others |= !rest.is_empty();
            }
            (op::IMAGE_WRITE, [image, ..]) if loaded.contains_key(image) => {
                uses.entry(loaded[image]).or_default().writes = true;
            }
            (op::IMAGE_QUERY_SIZE, [_, _, image]) if loaded.contains_key(image) => {}
            _ => {
                for id in list_images(instruction) {
                    let variable = loaded.get(id).unwrap_or(id);
                    if let Some(found) = uses.get_mut(variable) {
                        found.others = true;
                    }
                }
            }
        }
    }
    uses
}

/// Lists the operands of an instruction that may be images or pointers to them, and no numbers.
fn list_images(instruction: &Instruction) -> &[u32] {
    let operands = &instruction.operands[..];
    let places = match instruction.opcode {
        op::STORE | op::COPY_MEMORY => 0..2,
        op::RETURN_VALUE => 0..1,
        op::IMAGE_TEXEL_POINTER | op::COPY_OBJECT | op::ARRAY_LENGTH => 2..3,
        op::ACCESS_CHAIN..=op::PTR_ACCESS_CHAIN | op::IN_BOUNDS_PTR_ACCESS_CHAIN => 2..3,
        op::SAMPLED_IMAGE..=op::IMAGE_QUERY_SAMPLES => 2..3,
        op::SELECT | op::PHI => 2..operands.len(),
        op::FUNCTION_CALL => 3..operands.len(),
        _ => 0..0,
    };
    operands.get(places).unwrap_or_default()
}

/// Declares images that are only written.
fn declare_written(words: &mut Words, written: &BTreeSet<u32>) {
    let is_access =
        |kind: u32| [decoration::NON_READABLE, decoration::NON_WRITABLE].contains(&kind);
    let mut instructions = Vec::with_capacity(words.instructions.len());
    for instruction in std::mem::take(&mut words.instructions) {
        match (instruction.opcode, &instruction.operands[..]) {
            (op::DECORATE, [target, kind, ..]) if written.contains(target) && is_access(*kind) => {}
            (op::DECORATE, [target, decoration::BINDING, ..]) if written.contains(target) => {
                let access = [*target, decoration::NON_READABLE];
                instructions.push(Instruction::new(op::DECORATE, access));
                instructions.push(instruction);
            }
            _ => instructions.push(instruction),
        }
    }
    words.instructions = instructions;
}

/// Makes sampled textures of images that are only read.
fn sample_read(
    words: &mut Words,
    read: &BTreeSet<u32>,
    variables: &BTreeMap<u32, u32>,
    storage_types: &BTreeMap<u32, Instruction>,
) {
    if read.is_empty() {
        return;
    }
    let signed = (words.all(op::TYPE_INT)).find(|[_, width, signed]| [*width, *signed] == [32, 1]);
    let integer = signed.map_or_else(|| words.new_id(), |[id, ..]| id);
    let zero = words.new_id();
    // Sampled type, and pointer to it, of each storage type.
    let types: BTreeMap<u32, [u32; 2]> = (read.iter())
        .map(|variable| variables[variable])
        .collect::<BTreeSet<u32>>()
        .into_iter()
        .map(|storage| (storage, [words.new_id(), words.new_id()]))
        .collect();
    let mut declared = false;
    // Storage type of each image that was loaded.
    let mut loaded = BTreeSet::new();
    let mut instructions = Vec::with_capacity(words.instructions.len());
    for instruction in std::mem::take(&mut words.instructions) {
        match (instruction.opcode, &instruction.operands[..]) {
            (op::VARIABLE, [_, variable, ..]) if read.contains(variable) => {
                if !std::mem::replace(&mut declared, true) {
                    if signed.is_none() {
                        instructions.push(Instruction::new(op::TYPE_INT, [integer, 32, 1]));
                    }
                    instructions.push(Instruction::new(op::CONSTANT, [integer, zero, 0]));
                    for (storage, [sampled, pointer]) in &types {
                        let mut operands = storage_types[storage].operands.clone();
                        operands[0] = *sampled;
                        operands[6] = 1;
                        operands.truncate(8);
                        if let Some(format) = operands.get_mut(7) {
                            *format = 0;
                        }
                        instructions.push(Instruction::new(op::TYPE_IMAGE, operands));
                        let pointer = [*pointer, UNIFORM_CONSTANT, *sampled];
                        instructions.push(Instruction::new(op::TYPE_POINTER, pointer));
                    }
                }
                let [_, pointer] = types[&variables[variable]];
                let operands = [pointer, *variable, UNIFORM_CONSTANT];
                instructions.push(Instruction::new(op::VARIABLE, operands));
            }
            (op::DECORATE, [target, decoration::NON_WRITABLE, ..]) if read.contains(target) => {}
            (op::LOAD, [_, result, pointer, ..]) if read.contains(pointer) => {
                loaded.insert(*result);
                let [sampled, _] = types[&variables[pointer]];
                instructions.push(Instruction::new(op::LOAD, [sampled, *result, *pointer]));
            }
            (op::IMAGE_READ, [ty, result, image, at]) if loaded.contains(image) => {
                let operands = [*ty, *result, *image, *at, LOD, zero];
                instructions.push(Instruction::new(op::IMAGE_FETCH, operands));
            }
            (op::IMAGE_QUERY_SIZE, [ty, result, image]) if loaded.contains(image) => {
                let operands = [*ty, *result, *image, zero];
                instructions.push(Instruction::new(op::IMAGE_QUERY_SIZE_LOD, operands));
            }
            _ => instructions.push(instruction),
        }
    }
    words.instructions = instructions;
}
