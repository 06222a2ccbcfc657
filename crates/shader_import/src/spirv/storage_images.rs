//! Access of kernels to storage images, narrowed to what they do.
//!
//! GLSL often leaves `readonly` and `writeonly` out, and few formats of WebGPU can be read and
//! written at once. An image that is only written is declared so. One that is only read becomes a
//! sampled texture, which works for every format. One that is both becomes two variables first:
//! reads see its content before the pass. HLSL and Slang do not say in which format an image is
//! stored, and their compilers omit or guess it; filter.toml says.

use std::collections::{BTreeMap, BTreeSet};

use naga::{ImageClass, Module, Scalar, Span, StorageAccess, StorageFormat, Type, TypeInner};
use spirv::{Capability, Decoration, ImageFormat, ImageOperands, Op};

use super::words::{Instruction, Place, UNIFORM_CONSTANT, Words};

/// Operands of an image type: one that is 2 for storage images, and its format.
const SAMPLED: usize = 6;
const FORMAT: usize = 7;

/// Uses of one storage image.
#[derive(Clone, Copy, Default)]
struct Uses {
    reads: bool,
    writes: bool,
    /// Uses that the narrowing does not understand, such as passing it to a function.
    others: bool,
    /// True if the shader leaves its format open.
    is_open: bool,
}

/// Storage images of a module, and what it does with them.
pub(super) struct StorageImages {
    uses: BTreeMap<Place, Uses>,
    /// Places of images that were split from others, each with the place of the other.
    pub owners: BTreeMap<Place, Place>,
}

impl StorageImages {
    /// Splits images that are read and written, and makes naga accept those that are only read and
    /// those without a format.
    pub fn prepare(words: &mut Words) -> Self {
        let owners = split_images(words);
        let open = fill_formats(words);
        let variables = find_variables(words);
        let (mut uses, loaded) = find_uses(words, &variables);
        for (variable, image) in &variables {
            uses.entry(*variable).or_default().is_open = open.contains(image);
        }
        let is_read = |variable: &u32| uses[variable].reads && !uses[variable].writes;
        let read = loaded.iter().filter(|(_, variable)| is_read(variable));
        name_levels(words, &read.map(|(image, _)| *image).collect());
        let places = words.find_places();
        let placed = uses.into_iter();
        Self {
            uses: (placed.filter_map(|(variable, uses)| Some((*places.get(&variable)?, uses))))
                .collect(),
            owners,
        }
    }

    /// Narrows the variables of the module that naga made. `choose` finds the format of the image
    /// at a place and with a name, whose own may be open.
    pub fn narrow(
        &self,
        module: &mut Module,
        choose: impl Fn(Place, &str, bool) -> Option<StorageFormat>,
    ) {
        for (_, variable) in module.global_variables.iter_mut() {
            let place = variable
                .binding
                .map(|binding| (binding.group, binding.binding));
            let Some((place, uses)) = place.and_then(|place| Some((place, self.uses.get(&place)?)))
            else {
                continue;
            };
            let Type { name, mut inner } = module.types[variable.ty].clone();
            let TypeInner::Image { class, .. } = &mut inner else {
                continue;
            };
            let ImageClass::Storage { format, access } = *class else {
                continue;
            };
            let is_only = [uses.reads, uses.writes, uses.others];
            let called = variable.name.as_deref().unwrap_or_default();
            *class = match is_only {
                [true, false, false] => ImageClass::Sampled {
                    kind: Scalar::from(format).kind,
                    multi: false,
                },
                [.., others] => ImageClass::Storage {
                    format: choose(place, called, uses.is_open).unwrap_or(format),
                    access: match (uses.reads, others) {
                        (false, false) => StorageAccess::STORE,
                        _ => access,
                    },
                },
            };
            variable.ty = module.types.insert(Type { name, inner }, Span::UNDEFINED);
        }
    }
}

/// Finds the variables that are storage images, each with its image type.
fn find_variables(words: &Words) -> BTreeMap<u32, u32> {
    let images: BTreeSet<u32> = (words.instructions.iter())
        .filter(|instruction| is_storage_image(instruction))
        .map(|instruction| instruction.operands[0])
        .collect();
    let pointers: BTreeMap<u32, u32> = (words.all(Op::TypePointer))
        .filter(|[_, class, image]| *class == UNIFORM_CONSTANT && images.contains(image))
        .map(|[pointer, _, image]| (pointer, image))
        .collect();
    (words.all(Op::Variable))
        .filter_map(|[pointer, variable]| Some((variable, *pointers.get(&pointer)?)))
        .collect()
}

fn is_storage_image(ty: &Instruction) -> bool {
    ty.op == Op::TypeImage && ty.operands.get(SAMPLED) == Some(&2)
}

/// Gives types of storage images without a format one with the same kind of numbers; returns their
/// ids.
fn fill_formats(words: &mut Words) -> BTreeSet<u32> {
    // Nothing needs these once all have a format.
    let without = [
        Capability::StorageImageReadWithoutFormat as u32,
        Capability::StorageImageWriteWithoutFormat as u32,
    ];
    (words.instructions).retain(|instruction| {
        instruction.op != Op::Capability
            || !instruction
                .operands
                .iter()
                .any(|needed| without.contains(needed))
    });
    let integers: BTreeMap<u32, ImageFormat> = (words.all(Op::TypeInt))
        .map(|[id, _, signed]| match signed {
            0 => (id, ImageFormat::R32ui),
            _ => (id, ImageFormat::R32i),
        })
        .collect();
    let mut open = BTreeSet::new();
    for instruction in words
        .instructions
        .iter_mut()
        .filter(|instruction| is_storage_image(instruction))
    {
        if let [id, texel, .., format @ 0] =
            instruction.operands.get_mut(..=FORMAT).unwrap_or_default()
        {
            *format = *integers.get(texel).unwrap_or(&ImageFormat::Rgba32f) as u32;
            open.insert(*id);
        }
    }
    open
}

/// Splits images that a kernel both reads and writes in two variables. Returns the places of those
/// that are read, each with the place of the one that is written.
fn split_images(words: &mut Words) -> BTreeMap<Place, Place> {
    let (uses, loaded) = find_uses(words, &find_variables(words));
    let read: BTreeSet<u32> = (words.all(Op::ImageRead))
        .map(|[_, _, image]| image)
        .collect();
    // A load that serves both stays whole.
    let shared: BTreeSet<u32> = (words.all(Op::ImageWrite))
        .filter(|[image]| read.contains(image))
        .filter_map(|[image]| loaded.get(&image).copied())
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
    words.rewrite(|_, instruction| {
        let mut copy = instruction.clone();
        let (place, is_copied) = match (instruction.op, &instruction.operands[..]) {
            (Op::Name | Op::Decorate, [..]) => (0, true),
            (Op::Variable, _) => (1, true),
            (Op::Load, [_, image, ..]) if read.contains(image) => (2, false),
            _ => return None,
        };
        let variable = copy.operands.get_mut(place)?;
        let binding = free.get(variable)?.1;
        *variable = twins[variable];
        if let (Op::Decorate, [_, kind, value]) = (copy.op, &mut copy.operands[..])
            && *kind == Decoration::Binding as u32
        {
            *value = binding;
        }
        Some(if is_copied {
            vec![copy, instruction.clone()]
        } else {
            vec![copy]
        })
    });
    (free.into_iter())
        .map(|(variable, read)| (read, written[&variable]))
        .collect()
}

/// Finds what a module does with each variable, and the variable of each image that it loads.
fn find_uses(
    words: &Words,
    variables: &BTreeMap<u32, u32>,
) -> (BTreeMap<u32, Uses>, BTreeMap<u32, u32>) {
    let mut uses: BTreeMap<u32, Uses> = variables.keys().map(|id| (*id, Uses::default())).collect();
    let mut loaded = BTreeMap::new();
    for instruction in &words.instructions {
        match (instruction.op, &instruction.operands[..]) {
            (Op::Load, [_, result, pointer, ..]) if variables.contains_key(pointer) => {
                loaded.insert(*result, *pointer);
            }
            (Op::ImageRead, [_, _, image, _, rest @ ..]) if loaded.contains_key(image) => {
                let usage = uses.entry(loaded[image]).or_default();
                usage.reads = true;
                usage.others |= !rest.is_empty();
            }
            (Op::ImageWrite, [image, ..]) if loaded.contains_key(image) => {
                uses.entry(loaded[image]).or_default().writes = true;
            }
            (Op::ImageQuerySize, [_, _, image]) if loaded.contains_key(image) => {}
            _ => {
                for id in list_images(instruction) {
                    let variable = loaded.get(id).unwrap_or(id);
                    if let Some(usage) = uses.get_mut(variable) {
                        usage.others = true;
                    }
                }
            }
        }
    }
    (uses, loaded)
}

/// Lists the operands of an instruction that may be images or pointers to them, and no numbers.
fn list_images(instruction: &Instruction) -> &[u32] {
    let operands = &instruction.operands[..];
    let places = match instruction.op {
        Op::Store | Op::CopyMemory => 0..2,
        Op::ReturnValue => 0..1,
        Op::Select | Op::Phi => 2..operands.len(),
        Op::FunctionCall => 3..operands.len(),
        Op::ImageTexelPointer | Op::CopyObject | Op::ArrayLength => 2..3,
        Op::AccessChain | Op::InBoundsAccessChain => 2..3,
        Op::PtrAccessChain | Op::InBoundsPtrAccessChain => 2..3,
        op if (Op::SampledImage..=Op::ImageQuerySamples).contains(&op) => 2..3,
        _ => 0..0,
    };
    operands.get(places).unwrap_or_default()
}

/// Fetches texels from level 0 if a module names none: `texture[pixel]` of Slang, and reads of the
/// storage images in `read`. naga requires a level for a sampled texture.
fn name_levels(words: &mut Words, read: &BTreeSet<u32>) {
    let is_bare = |instruction: &Instruction| match (instruction.op, &instruction.operands[..]) {
        (Op::ImageFetch, [_, _, _, _]) => true,
        (Op::ImageRead, [_, _, image, _]) => read.contains(image),
        _ => false,
    };
    if !words.instructions.iter().any(is_bare) {
        return;
    }
    let signed = (words.all(Op::TypeInt)).find(|[_, width, signed]| [*width, *signed] == [32, 1]);
    let integer = signed.map_or_else(|| words.new_id(), |[id, ..]| id);
    let zero = words.new_id();
    let mut declared = false;
    words.rewrite(|_, instruction| {
        if instruction.op == Op::Function && !std::mem::replace(&mut declared, true) {
            let ty = Instruction::new(Op::TypeInt, [integer, 32, 1]);
            let constant = Instruction::new(Op::Constant, [integer, zero, 0]);
            let ty = signed.is_none().then_some(ty);
            return Some(
                ty.into_iter()
                    .chain([constant, instruction.clone()])
                    .collect(),
            );
        }
        is_bare(instruction).then(|| {
            let mut fetch = instruction.clone();
            fetch.operands.extend([ImageOperands::LOD.bits(), zero]);
            vec![fetch]
        })
    });
}
