//! Uniform blocks of shaders, filled with values that filter.toml names.

use wgpu::naga::Scalar;

use crate::filter::Expression;

/// A uniform block, and where its numbers lie.
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

/// Type of a number of 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NumberKind {
    Float,
    Signed,
    Unsigned,
}

impl NumberKind {
    /// Returns the kind of a scalar; none for those of other sizes.
    pub fn of(scalar: Scalar) -> Option<Self> {
        match scalar {
            Scalar::F32 => Some(Self::Float),
            Scalar::I32 => Some(Self::Signed),
            Scalar::U32 => Some(Self::Unsigned),
            _ => None,
        }
    }

    /// Names the type as WGSL does.
    pub fn name(self) -> &'static str {
        match self {
            Self::Float => "f32",
            Self::Signed => "i32",
            Self::Unsigned => "u32",
        }
    }
}

impl UniformBlock {
    /// Encodes the block with the values of names. Whole numbers are rounded to the nearest.
    pub fn encode(&self, value: &dyn Fn(&str) -> f64) -> Vec<u8> {
        let mut bytes = vec![0; (self.bytes as usize).next_multiple_of(16)];
        for number in &self.numbers {
            let value = number.value.evaluate(value);
            let encoded = match number.kind {
                NumberKind::Float => (value as f32).to_ne_bytes(),
                NumberKind::Signed => (value.round() as i32).to_ne_bytes(),
                NumberKind::Unsigned => (value.round() as u32).to_ne_bytes(),
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
