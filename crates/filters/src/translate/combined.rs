//! Split of combined image samplers (`sampler2D` of GLSL) into a texture and a sampler.
//!
//! WGSL and wgpu know no combined ones. A variable keeps its binding for the texture, and its sampler gets a free one. A function
//! that takes a combined one takes two parameters instead.

use std::collections::BTreeMap;

use super::words::{Instruction, Place, UNIFORM_CONSTANT, Words, decoration, op};

/// Types that stand for those of combined ones.
struct SplitTypes {
    image: u32,
    image_pointer: u32,
    sampler: u32,
    sampler_pointer: u32,
}

/// Splits every combined image sampler. Returns the places of the new samplers, each with the place of its texture.
pub(super) fn split_combined_samplers(words: &mut Words) -> Result<BTreeMap<Place, Place>, String> {
    let images: BTreeMap<u32, u32> = (words.all(op::TYPE_SAMPLED_IMAGE))
        .map(|[combined, image]| (combined, image))
        .collect();
    let arrays = (words.all(op::TYPE_ARRAY)).chain(words.all(op::TYPE_RUNTIME_ARRAY));
    if arrays
        .into_iter()
        .any(|[_, element]| images.contains_key(&element))
    {
        return Err("has an array of combined image samplers; allowed: single ones".into());
    }
    let pointers: BTreeMap<u32, u32> = (words.all(op::TYPE_POINTER))
        .filter(|[_, _, pointee]| images.contains_key(pointee))
        .map(|[pointer, _, pointee]| (pointer, pointee))
        .collect();
    let variables: Vec<u32> = (words.all(op::VARIABLE))
        .filter(|[pointer, _]| pointers.contains_key(pointer))
        .map(|[_, variable]| variable)
        .collect();
    let parameters: Vec<u32> = (words.all(op::FUNCTION_PARAMETER))
        .filter(|[pointer, _]| pointers.contains_key(pointer))
        .map(|[_, parameter]| parameter)
        .collect();
    // The sampler of each combined variable or parameter.
    let samplers: BTreeMap<u32, u32> = (variables.iter().chain(&parameters))
        .map(|combined| (*combined, words.new_id()))
        .collect();
    let types: BTreeMap<u32, SplitTypes> = (pointers.iter())
        .map(|(pointer, combined)| {
            let types = SplitTypes {
                image: images[combined],
                image_pointer: words.new_id(),
                sampler: words.new_id(),
                sampler_pointer: words.new_id(),
            };
            (*pointer, types)
        })
        .collect();
    let textures = words.find_places();
    let places = words.find_free_places(&variables);
    let mut split = Vec::with_capacity(words.instructions.len());
    // Type and pointers of loads that take a combined one.
    for instruction in std::mem::take(&mut words.instructions) {
        let replaced = match (instruction.opcode, instruction.first::<3>()) {
            (op::FUNCTION_PARAMETER, _) => {
                let Some([pointer, parameter]) = instruction.first() else {
                    continue;
                };
                types.get(&pointer).map(|types| {
                    let make = |ty, id| Instruction::new(op::FUNCTION_PARAMETER, [ty, id]);
                    vec![
                        make(types.image_pointer, parameter),
                        make(types.sampler_pointer, samplers[&parameter]),
                    ]
                })
            }
            (op::TYPE_POINTER, Some([pointer, ..])) => types.get(&pointer).map(|types| {
                let make = |id, pointee| {
                    Instruction::new(op::TYPE_POINTER, [id, UNIFORM_CONSTANT, pointee])
                };
                vec![
                    instruction.clone(),
                    Instruction::new(op::TYPE_SAMPLER, [types.sampler]),
                    make(types.sampler_pointer, types.sampler),
                    make(types.image_pointer, types.image),
                ]
            }),
            (op::VARIABLE, Some([pointer, variable, _])) => types.get(&pointer).map(|types| {
                let make = |ty, id| Instruction::new(op::VARIABLE, [ty, id, UNIFORM_CONSTANT]);
                vec![
                    make(types.image_pointer, variable),
                    make(types.sampler_pointer, samplers[&variable]),
                ]
            }),
            (op::TYPE_FUNCTION, Some([function, result, _])) => {
                let parameters = instruction.operands[2..].iter();
                let split = parameters.flat_map(|ty| match types.get(ty) {
                    Some(types) => vec![types.image_pointer, types.sampler_pointer],
                    None => vec![*ty],
                });
                let operands: Vec<u32> = [function, result].into_iter().chain(split).collect();
                Some(vec![Instruction::new(op::TYPE_FUNCTION, operands)])
            }
            (op::FUNCTION_CALL, Some([ty, result, function])) => {
                let arguments = instruction.operands[3..].iter();
                let split = arguments
                    .flat_map(|id| [Some(*id), samplers.get(id).copied()])
                    .flatten();
                let operands: Vec<u32> = [ty, result, function].into_iter().chain(split).collect();
                Some(vec![Instruction::new(op::FUNCTION_CALL, operands)])
            }
            (op::LOAD, Some([combined, result, pointer])) => {
                let image = images.get(&combined).copied();
                let sampler = samplers.get(&pointer).copied();
                image.zip(sampler).map(|(image_type, sampler)| {
                    let (image, loaded_sampler) = (words.new_id(), words.new_id());
                    let sampler_type = (types.values().next()).map_or(0, |types| types.sampler);
                    vec![
                        Instruction::new(op::LOAD, [image_type, image, pointer]),
                        Instruction::new(op::LOAD, [sampler_type, loaded_sampler, sampler]),
                        Instruction::new(
                            op::SAMPLED_IMAGE,
                            [combined, result, image, loaded_sampler],
                        ),
                    ]
                })
            }
            (op::DECORATE, Some([target, kind, value])) => {
                (samplers.get(&target).zip(places.get(&target))).map(|(sampler, (_, own))| {
                    let value = match kind {
                        decoration::BINDING => *own,
                        _ => value,
                    };
                    let copy = Instruction::new(op::DECORATE, [*sampler, kind, value]);
                    vec![instruction.clone(), copy]
                })
            }
            _ => None,
        };
        match replaced {
            Some(replaced) => split.extend(replaced),
            None => split.push(instruction),
        }
    }
    words.instructions = split;
    Ok((places.into_iter())
        .map(|(variable, sampler)| (sampler, textures[&variable]))
        .collect())
}
