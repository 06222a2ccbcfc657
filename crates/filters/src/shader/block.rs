//! Uniform blocks of shaders, filled with values by name.

use wgpu::naga::proc::Layouter;
use wgpu::naga::{ArraySize, Handle, Module, Scalar, Type, TypeInner, VectorSize};

use crate::Expression;

/// Upper limit on the numbers of a block.
const MAX_NUMBERS: usize = 1024;

/// Upper limit on its bytes, which every adapter grants.
const MAX_BYTES: u32 = 64 << 10;

/// A member of a block: its name, its place and its numbers.
pub(crate) struct Member {
    pub name: String,
    /// Offset in bytes.
    pub offset: u32,
    /// Places and kinds of its numbers.
    pub numbers: Vec<(u32, NumberKind)>,
}

/// A uniform block, and the places of its numbers.
#[derive(Clone, Debug)]
pub(crate) struct UniformBlock {
    /// Its size.
    pub bytes: u32,
    pub numbers: Vec<BlockNumber>,
}

/// A number of a uniform block.
#[derive(Clone, Debug)]
pub(crate) struct BlockNumber {
    /// Offset in bytes.
    pub offset: u32,
    pub kind: NumberKind,
    pub value: Expression,
}

/// Type of a number of 32 bits, as WGSL names it.
pub(crate) type NumberKind = &'static str;

/// Returns the kind of a scalar; none for those of other sizes.
fn find_kind(scalar: Scalar) -> Option<NumberKind> {
    match scalar {
        Scalar::F32 => Some("f32"),
        Scalar::I32 => Some("i32"),
        Scalar::U32 => Some("u32"),
        _ => None,
    }
}

impl UniformBlock {
    /// Refuses a block that is larger than adapters grant, or too small for its numbers.
    pub fn new(
        module: &Module,
        block: Handle<Type>,
        numbers: Vec<BlockNumber>,
    ) -> Result<Self, String> {
        let mut layouter = Layouter::default();
        (layouter.update(module.to_ctx())).map_err(|error| format!("has no layout: {error}"))?;
        let bytes = layouter[block].size;
        let is_outside = |number: &BlockNumber| number.offset.saturating_add(4) > bytes;
        if bytes > MAX_BYTES || numbers.iter().any(is_outside) {
            return Err(format!(
                "takes {bytes} bytes; allowed: at most {MAX_BYTES}, with all members in it"
            ));
        }
        Ok(Self { bytes, numbers })
    }

    /// Makes a block with numbers named after its members: `prefix`, the member, and the index of
    /// the number if there are several.
    pub fn by_name(module: &Module, block: Handle<Type>, prefix: &str) -> Result<Self, String> {
        let mut numbers = Vec::new();
        for member in list_members(module, block)? {
            let count = member.numbers.len();
            for (index, (offset, kind)) in member.numbers.into_iter().enumerate() {
                let name = format!("{prefix}{}", member.name);
                let value = Expression::Name(match count {
                    1 => name,
                    _ => name_element(&name, index),
                });
                numbers.push(BlockNumber {
                    offset,
                    kind,
                    value,
                });
            }
        }
        Self::new(module, block, numbers)
    }

    /// Encodes the block with the values of names. Whole numbers are rounded to the nearest.
    pub fn encode(&self, value: &dyn Fn(&str) -> f64) -> Vec<u8> {
        let mut bytes = vec![0; (self.bytes as usize).next_multiple_of(16)];
        for number in &self.numbers {
            let value = number.value.evaluate(value);
            let encoded = match number.kind {
                "f32" => (value as f32).to_ne_bytes(),
                "i32" => (value.round() as i32).to_ne_bytes(),
                _ => (value.round() as u32).to_ne_bytes(),
            };
            let start = number.offset as usize;
            bytes[start..start + 4].copy_from_slice(&encoded);
        }
        bytes
    }

    /// Returns true if a value depends on a name.
    pub fn reads(&self, name: &str) -> bool {
        self.reads_any(&|known| known == name)
    }

    /// Returns true if a value depends on one of several names.
    pub fn reads_any(&self, is_wanted: &dyn Fn(&str) -> bool) -> bool {
        (self.numbers.iter()).any(|number| number.value.reads_any(is_wanted))
    }
}

/// Names one number of several.
pub(crate) fn name_element(whole: &str, index: usize) -> String {
    format!("{whole}[{index}]")
}

/// Lists the members of a block.
pub(crate) fn list_members(module: &Module, block: Handle<Type>) -> Result<Vec<Member>, String> {
    let ty = &module.types[block];
    let mut left = MAX_NUMBERS;
    let mut list = |name: String, ty, offset| {
        let mut numbers = Vec::new();
        list_numbers(module, ty, offset, &mut left, &mut numbers)
            .map_err(|reason| format!("its member \"{name}\" {reason}"))?;
        Ok(Member {
            name,
            offset,
            numbers,
        })
    };
    match &ty.inner {
        TypeInner::Struct { members, .. } => (members.iter())
            .map(|member| {
                let name = member
                    .name
                    .clone()
                    .unwrap_or_else(|| format!("@{}", member.offset));
                list(name, member.ty, member.offset)
            })
            .collect(),
        _ => Ok(vec![list("@0".to_owned(), block, 0)?]),
    }
}

/// Lists the numbers of a type in order.
fn list_numbers(
    module: &Module,
    ty: Handle<Type>,
    offset: u32,
    left: &mut usize,
    numbers: &mut Vec<(u32, NumberKind)>,
) -> Result<(), String> {
    let mut row = |offset: u32, count: u32, scalar: Scalar| {
        let kind = find_kind(scalar).ok_or("holds numbers that are not of 32 bits")?;
        *left = (left.checked_sub(count as usize))
            .ok_or_else(|| format!("makes the block hold more than {MAX_NUMBERS} numbers"))?;
        numbers.extend((0..count).map(|index| (offset.saturating_add(4 * index), kind)));
        Ok::<(), String>(())
    };
    match &module.types[ty].inner {
        TypeInner::Scalar(scalar) => row(offset, 1, *scalar),
        TypeInner::Vector { size, scalar } => row(offset, *size as u32, *scalar),
        TypeInner::Matrix {
            columns,
            rows,
            scalar,
        } => {
            let stride = match rows {
                VectorSize::Bi => 8,
                VectorSize::Tri | VectorSize::Quad => 16,
            };
            (0..*columns as u32).try_for_each(|column| {
                row(
                    offset.saturating_add(column * stride),
                    *rows as u32,
                    *scalar,
                )
            })
        }
        TypeInner::Array {
            base,
            size: ArraySize::Constant(count),
            stride,
        } => (0..count.get()).try_for_each(|index| {
            let offset = offset.saturating_add(index.saturating_mul(*stride));
            // An array of empty structs is refused by its length.
            *left = left.checked_sub(1).ok_or("is too long")?;
            let listed = list_numbers(module, *base, offset, left, numbers);
            *left += 1;
            listed
        }),
        TypeInner::Struct { members, .. } => members.iter().try_for_each(|member| {
            let offset = offset.saturating_add(member.offset);
            list_numbers(module, member.ty, offset, left, numbers)
        }),
        _ => Err("is no number, vector, matrix, array of known length, or struct of these".into()),
    }
}
