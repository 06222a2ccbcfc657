//! Uniform blocks of shaders, and storage buffers that they only read, filled with values by name.

use wgpu::naga::proc::Layouter;
use wgpu::naga::{ArraySize, Handle, Module, Type, TypeInner};

use super::member::{NumberKind, list_members, name_element};
use crate::Expression;

/// Upper limit on the bytes of a block, which every adapter grants.
const MAX_BYTES: u32 = 64 << 10;

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

    /// Returns the size of its buffer. That of a storage buffer is exact: it says how long the last
    /// array is.
    pub fn buffer_bytes(&self) -> usize {
        if self.is_storage {
            self.bytes as usize
        } else {
            (self.bytes as usize).next_multiple_of(16)
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
