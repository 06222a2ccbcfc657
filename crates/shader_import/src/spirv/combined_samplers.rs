//! Split of combined image samplers (`sampler2D` of GLSL) into a texture and a sampler.
//!
//! WGSL and wgpu have no combined ones. A variable keeps its binding for the texture, and its
//! sampler gets a free one. A function with a combined parameter has two parameters instead.

use std::collections::BTreeMap;

use spirv::{Decoration, Op};

use super::words::{Instruction, Place, UNIFORM_CONSTANT, Words};

/// Ids that stand for combined image samplers.
struct Split {
    /// Image types by the combined type.
    images: BTreeMap<u32, u32>,
    /// New types by the pointer to the combined type.
    types: BTreeMap<u32, SplitTypes>,
    /// The sampler of each combined variable or parameter; it has the same name, so that a binding
    /// by name explains both.
    samplers: BTreeMap<u32, u32>,
    /// Places of the samplers of variables.
    places: BTreeMap<u32, Place>,
}

/// Types that replace a combined one.
struct SplitTypes {
    image: u32,
    image_pointer: u32,
    sampler: u32,
    sampler_pointer: u32,
}

/// Splits every combined image sampler. Returns the places of the new samplers, each with the place
/// of its texture.
pub(super) fn split_combined_samplers(words: &mut Words) -> Result<BTreeMap<Place, Place>, String> {
    let images: BTreeMap<u32, u32> = (words.all(Op::TypeSampledImage))
        .map(|[combined, image]| (combined, image))
        .collect();
    let mut arrays = (words.all(Op::TypeArray)).chain(words.all(Op::TypeRuntimeArray));
    if arrays.any(|[_, element]| images.contains_key(&element)) {
        return Err("has an array of combined image samplers; allowed: single ones".into());
    }
    drop(arrays);
    let pointers: Vec<[u32; 2]> = (words.all(Op::TypePointer))
        .filter_map(|[pointer, _, combined]| Some([pointer, *images.get(&combined)?]))
        .collect();
    let types: BTreeMap<u32, SplitTypes> = (pointers.into_iter())
        .map(|[pointer, image]| {
            let types = SplitTypes {
                image,
                image_pointer: words.new_id(),
                sampler: words.new_id(),
                sampler_pointer: words.new_id(),
            };
            (pointer, types)
        })
        .collect();
    let declared = |words: &Words, op| -> Vec<u32> {
        let declared = words.all(op);
        let combined = declared.filter(|[pointer, _]| types.contains_key(pointer));
        combined.map(|[_, id]| id).collect()
    };
    let variables = declared(words, Op::Variable);
    let parameters = declared(words, Op::FunctionParameter);
    let textures = words.find_places();
    let split = Split {
        places: words.find_free_places(&variables),
        samplers: (variables.into_iter().chain(parameters))
            .map(|combined| (combined, words.new_id()))
            .collect(),
        images,
        types,
    };
    words.rewrite(|words, instruction| split.replace(words, instruction));
    Ok((split.places.into_iter())
        .map(|(variable, sampler)| (sampler, textures[&variable]))
        .collect())
}

impl Split {
    /// Returns what an instruction becomes if it names a combined one.
    fn replace(&self, words: &mut Words, instruction: &Instruction) -> Option<Vec<Instruction>> {
        let op = instruction.op;
        let make = |op, operands: Vec<u32>| Instruction::new(op, operands);
        Some(match (op, &instruction.operands[..]) {
            (Op::TypePointer, [pointer, ..]) => {
                let types = self.types.get(pointer)?;
                let pointer = |id, to| make(op, vec![id, UNIFORM_CONSTANT, to]);
                vec![
                    instruction.clone(),
                    make(Op::TypeSampler, vec![types.sampler]),
                    pointer(types.sampler_pointer, types.sampler),
                    pointer(types.image_pointer, types.image),
                ]
            }
            (Op::Variable | Op::FunctionParameter, [pointer, id, class @ ..]) => {
                let types = self.types.get(pointer)?;
                let declare = |ty, id| make(op, [&[ty, id], class].concat());
                vec![
                    declare(types.image_pointer, *id),
                    declare(types.sampler_pointer, self.samplers[id]),
                ]
            }
            (Op::TypeFunction, [function, result, parameters @ ..]) => {
                let split = parameters.iter().flat_map(|ty| match self.types.get(ty) {
                    Some(types) => vec![types.image_pointer, types.sampler_pointer],
                    None => vec![*ty],
                });
                let head = [*function, *result].into_iter();
                vec![make(op, head.chain(split).collect())]
            }
            (Op::FunctionCall, ids) => {
                let sampler = |id: &u32| self.samplers.get(id).copied();
                let split = ids.iter().flat_map(|id| [Some(*id), sampler(id)]);
                vec![make(op, split.flatten().collect())]
            }
            (Op::Load, [combined, result, pointer, ..]) => {
                let image_type = *self.images.get(combined)?;
                let sampler = *self.samplers.get(pointer)?;
                let sampler_type = self.types.values().next()?.sampler;
                let (image, loaded) = (words.new_id(), words.new_id());
                vec![
                    make(op, vec![image_type, image, *pointer]),
                    make(op, vec![sampler_type, loaded, sampler]),
                    make(Op::SampledImage, vec![*combined, *result, image, loaded]),
                ]
            }
            (Op::Name, [target, name @ ..]) => {
                let named = [&[*self.samplers.get(target)?], name].concat();
                vec![instruction.clone(), make(op, named)]
            }
            (Op::Decorate, [target, kind, value, ..]) => {
                let (sampler, (_, binding)) =
                    (self.samplers.get(target)?, self.places.get(target)?);
                let is_binding = *kind == Decoration::Binding as u32;
                let value = if is_binding { *binding } else { *value };
                vec![instruction.clone(), make(op, vec![*sampler, *kind, value])]
            }
            _ => return None,
        })
    }
}
