//! Texels of textures, as filter.toml and kernels declare them.

use serde::{Deserialize, Serialize};

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
}

impl Format {
    /// Every format.
    pub(crate) const ALL: [Self; 9] = [
        Self::R32Uint,
        Self::R32Float,
        Self::Rg32Float,
        Self::Rgba32Float,
        Self::R16Float,
        Self::Rg16Float,
        Self::Rgba16Float,
        Self::R8Unorm,
        Self::Rgba8Unorm,
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
        }
    }

    /// Returns how many numbers a texel holds.
    pub(crate) fn components(self) -> usize {
        match self {
            Self::R32Uint | Self::R32Float | Self::R16Float | Self::R8Unorm => 1,
            Self::Rg32Float | Self::Rg16Float => 2,
            Self::Rgba32Float | Self::Rgba16Float | Self::Rgba8Unorm => 4,
        }
    }

    /// Returns the bytes of each number.
    pub(crate) fn component_bytes(self) -> usize {
        match self {
            Self::R32Uint | Self::R32Float | Self::Rg32Float | Self::Rgba32Float => 4,
            Self::R16Float | Self::Rg16Float | Self::Rgba16Float => 2,
            Self::R8Unorm | Self::Rgba8Unorm => 1,
        }
    }

    /// Returns true for numbers with a fraction, a sign and a NaN.
    pub(crate) fn is_float(self) -> bool {
        !matches!(self, Self::R32Uint | Self::R8Unorm | Self::Rgba8Unorm)
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
