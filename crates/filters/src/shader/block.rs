//! Uniform blocks of shaders, and storage buffers that they only read, filled with values by name.

use wgpu::naga::proc::Layouter;
use wgpu::naga::{ArraySize, Handle, Module, Scalar, Type, TypeInner, VectorSize};

use crate::Expression;

/// Upper limit on the numbers of a block.
const MAX_NUMBERS: usize = 1024;

/// Upper limit on its bytes, which every adapter grants.
const MAX_BYTES: u32 = 64 << 10;

/// A member of a block: its name, its place and its numbers.
pub(crate) struct Member {
    /// Path from the block, such as `GBuffer.ScreenSize`.
    pub name: String,
    /// Offset in bytes.
    pub offset: u32,
    /// Offset in bytes in the struct that declares it.
    pub own_offset: u32,
    /// Places and kinds of its numbers.
    pub numbers: Vec<(u32, NumberKind)>,
}

/// A uniform block or a storage buffer, and where its numbers lie.
#[derive(Clone, Debug)]
pub(crate) struct UniformBlock {
    /// Its size.
    bytes: u32,
    pub numbers: Vec<BlockNumber>,
    /// True for a storage buffer.
    pub is_storage: bool,
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
        let mut bytes = layouter[block].size;
        if let Some((offset, stride)) = find_open_array(module, block) {
            let end = numbers
                .last()
                .map_or(0, |last| last.offset.saturating_add(4));
            let array = end.saturating_sub(offset).checked_next_multiple_of(stride);
            bytes = bytes.max(array.map_or(u32::MAX, |array| offset.saturating_add(array)));
        }
        let is_outside = |number: &BlockNumber| number.offset.saturating_add(4) > bytes;
        if bytes > MAX_BYTES || numbers.iter().any(is_outside) {
            return Err(format!(
                "takes {bytes} bytes; allowed: at most {MAX_BYTES}, with all members in it"
            ));
        }
        Ok(Self {
            bytes,
            numbers,
            is_storage: false,
        })
    }

    /// Returns the size of its buffer. That of a storage buffer is exact: it says how long the last array is.
    pub fn buffer_bytes(&self) -> usize {
        match self.is_storage {
            true => self.bytes as usize,
            false => (self.bytes as usize).next_multiple_of(16),
        }
    }

    /// Makes a block with numbers named after its members: `prefix`, the member, and the index of
    /// the number if there are several.
    pub fn by_name(module: &Module, block: Handle<Type>, prefix: &str) -> Result<Self, String> {
        let mut numbers = Vec::new();
        for member in list_members(module, block, &|_, _| 0)? {
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
        let mut bytes = vec![0; self.buffer_bytes()];
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

/// Finds the array without a length that a block ends with: its offset and its stride.
fn find_open_array(module: &Module, block: Handle<Type>) -> Option<(u32, u32)> {
    let (offset, ty) = match &module.types[block].inner {
        TypeInner::Struct { members, .. } => members.last().map(|last| (last.offset, last.ty))?,
        _ => (0, block),
    };
    match module.types[ty].inner {
        TypeInner::Array {
            size: ArraySize::Dynamic,
            stride,
            ..
        } => Some((offset, stride)),
        _ => None,
    }
}

/// Names one number of several.
pub(crate) fn name_element(whole: &str, index: usize) -> String {
    format!("{whole}[{index}]")
}

/// Lists the members of a block; those of structs in it by their paths. `find_length` says how many numbers an array without a length
/// gets, by its name and offset.
pub(crate) fn list_members(
    module: &Module,
    block: Handle<Type>,
    find_length: &dyn Fn(&str, u32) -> usize,
) -> Result<Vec<Member>, String> {
    let mut lister = Lister {
        module,
        find_length,
        left: MAX_NUMBERS,
        members: Vec::new(),
    };
    lister.list(String::new(), block, 0, 0)?;
    Ok(lister.members)
}

/// Members of a block, listed so far.
struct Lister<'a> {
    module: &'a Module,
    find_length: &'a dyn Fn(&str, u32) -> usize,
    /// Numbers that it may still have.
    left: usize,
    members: Vec<Member>,
}

impl Lister<'_> {
    /// Lists what lies at a path and an offset; `own_offset` is that within the innermost struct.
    fn list(
        &mut self,
        path: String,
        ty: Handle<Type>,
        offset: u32,
        own_offset: u32,
    ) -> Result<(), String> {
        let types = &self.module.types;
        match &types[ty].inner {
            TypeInner::Struct { members, .. } => members.iter().try_for_each(|member| {
                let name = member.name.clone();
                let name = name.unwrap_or_else(|| format!("@{}", member.offset));
                let path = match &path[..] {
                    "" => name,
                    path => format!("{path}.{name}"),
                };
                let place = offset.saturating_add(member.offset);
                self.list(path, member.ty, place, member.offset)
            }),
            TypeInner::Array {
                base,
                size: ArraySize::Constant(count),
                stride,
            } if matches!(types[*base].inner, TypeInner::Struct { .. }) => (0..count.get())
                .try_for_each(|index| {
                    let place = offset.saturating_add(index.saturating_mul(*stride));
                    self.list(name_element(&path, index as usize), *base, place, 0)
                }),
            _ => {
                let name = if path.is_empty() { "@0".into() } else { path };
                let numbers = (self.list_whole(&name, ty, offset))
                    .map_err(|reason| format!("its member \"{name}\" {reason}"))?;
                self.members.push(Member {
                    name,
                    offset,
                    own_offset,
                    numbers,
                });
                Ok(())
            }
        }
    }

    /// Lists the numbers of a member: all of an array without a length.
    fn list_whole(
        &mut self,
        name: &str,
        ty: Handle<Type>,
        offset: u32,
    ) -> Result<Vec<(u32, NumberKind)>, String> {
        let mut numbers = Vec::new();
        let mut list = |ty, offset| {
            list_numbers(self.module, ty, offset, &mut self.left, &mut numbers)?;
            Ok::<usize, String>(numbers.len())
        };
        match self.module.types[ty].inner {
            TypeInner::Array {
                base,
                size: ArraySize::Dynamic,
                stride,
            } => {
                let of_element = list(base, offset)?.max(1);
                for index in 1..(self.find_length)(name, offset) / of_element {
                    let place = (index as u32).saturating_mul(stride);
                    list(base, offset.saturating_add(place))?;
                }
            }
            _ => _ = list(ty, offset)?,
        }
        Ok(numbers)
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
