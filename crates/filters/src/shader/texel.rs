//! Texels of textures, as filter.toml and kernels declare them.

use serde::{Deserialize, Serialize};
use wgpu::naga::StorageFormat;

/// Texel format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// One whole number from 0, of 32 bits.
    R32Uint,
    /// One number of 32 bits.
    R32Float,
    /// Two numbers of 32 bits.
    Rg32Float,
    /// Four numbers of 32 bits.
    Rgba32Float,
    /// One number of 16 bits.
    R16Float,
    /// Two numbers of 16 bits.
    Rg16Float,
    /// Four numbers of 16 bits.
    Rgba16Float,
    /// One number from 0 to 1, of 8 bits.
    R8Unorm,
    /// Four numbers from 0 to 1, of 8 bits.
    Rgba8Unorm,
    /// Three numbers from 0 to 1, of 10 bits, and one of 2.
    Rgb10a2Unorm,
    /// Three numbers from 0, of 11, 11 and 10 bits, five of them for the exponent.
    Rg11b10Ufloat,
}

impl Format {
    /// Every format.
    pub(crate) const ALL: [Self; 11] = [
        Self::R32Uint,
        Self::R32Float,
        Self::Rg32Float,
        Self::Rgba32Float,
        Self::R16Float,
        Self::Rg16Float,
        Self::Rgba16Float,
        Self::R8Unorm,
        Self::Rgba8Unorm,
        Self::Rgb10a2Unorm,
        Self::Rg11b10Ufloat,
    ];

    /// Returns its name in filter.toml and in WGSL.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::R32Uint => "r32uint",
            Self::R32Float => "r32float",
            Self::Rg32Float => "rg32float",
            Self::Rgba32Float => "rgba32float",
            Self::R16Float => "r16float",
            Self::Rg16Float => "rg16float",
            Self::Rgba16Float => "rgba16float",
            Self::R8Unorm => "r8unorm",
            Self::Rgba8Unorm => "rgba8unorm",
            Self::Rgb10a2Unorm => "rgb10a2unorm",
            Self::Rg11b10Ufloat => "rg11b10ufloat",
        }
    }

    /// Returns how many numbers a texel is given as and read as.
    pub(crate) fn components(self) -> usize {
        match self {
            Self::R32Uint | Self::R32Float | Self::R16Float | Self::R8Unorm => 1,
            Self::Rg32Float | Self::Rg16Float => 2,
            Self::Rgba32Float
            | Self::Rgba16Float
            | Self::Rgba8Unorm
            | Self::Rgb10a2Unorm
            | Self::Rg11b10Ufloat => 4,
        }
    }

    /// Returns the bytes of a texel.
    pub(crate) fn texel_bytes(self) -> u64 {
        match self {
            Self::R8Unorm => 1,
            Self::R16Float => 2,
            Self::R32Uint
            | Self::R32Float
            | Self::Rg16Float
            | Self::Rgba8Unorm
            | Self::Rgb10a2Unorm
            | Self::Rg11b10Ufloat => 4,
            Self::Rg32Float | Self::Rgba16Float => 8,
            Self::Rgba32Float => 16,
        }
    }

    /// Returns the format of a storage texture.
    pub(crate) fn stored(self) -> StorageFormat {
        match self {
            Self::R32Uint => StorageFormat::R32Uint,
            Self::R32Float => StorageFormat::R32Float,
            Self::Rg32Float => StorageFormat::Rg32Float,
            Self::Rgba32Float => StorageFormat::Rgba32Float,
            Self::R16Float => StorageFormat::R16Float,
            Self::Rg16Float => StorageFormat::Rg16Float,
            Self::Rgba16Float => StorageFormat::Rgba16Float,
            Self::R8Unorm => StorageFormat::R8Unorm,
            Self::Rgba8Unorm => StorageFormat::Rgba8Unorm,
            Self::Rgb10a2Unorm => StorageFormat::Rgb10a2Unorm,
            Self::Rg11b10Ufloat => StorageFormat::Rg11b10Ufloat,
        }
    }

    /// Returns the format of as many floats of 32 bits; formats of other numbers than floats stay.
    pub(crate) fn widened(self) -> Self {
        match self {
            Self::R16Float => Self::R32Float,
            Self::Rg16Float => Self::Rg32Float,
            Self::Rgba16Float | Self::Rg11b10Ufloat => Self::Rgba32Float,
            _ => self,
        }
    }

    /// Returns true for floats of 32 bits, which not every adapter interpolates.
    pub(crate) fn is_full_float(self) -> bool {
        matches!(self, Self::R32Float | Self::Rg32Float | Self::Rgba32Float)
    }
}

/// Type of the numbers in a texture that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Texel {
    /// `f32`.
    Float,
    /// `u32`.
    Uint,
}

impl Texel {
    /// Returns the type of the numbers in a format.
    pub fn of(format: Format) -> Self {
        match format {
            Format::R32Uint => Texel::Uint,
            _ => Texel::Float,
        }
    }
}
