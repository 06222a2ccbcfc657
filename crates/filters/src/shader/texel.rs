//! Texels of textures, as filter.toml and kernels declare them.

use serde::{Deserialize, Serialize};
use wgpu::TextureFormat;
use wgpu::naga::{ScalarKind, StorageFormat};

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

    /// Returns its name in filter.toml and in WGSL, how many numbers a texel is passed as, and its formats as a
    /// texture and as a storage texture.
    fn describe(self) -> (&'static str, usize, TextureFormat, StorageFormat) {
        use StorageFormat as S;
        use TextureFormat as T;
        match self {
            Self::R32Uint => ("r32uint", 1, T::R32Uint, S::R32Uint),
            Self::R32Float => ("r32float", 1, T::R32Float, S::R32Float),
            Self::Rg32Float => ("rg32float", 2, T::Rg32Float, S::Rg32Float),
            Self::Rgba32Float => ("rgba32float", 4, T::Rgba32Float, S::Rgba32Float),
            Self::R16Float => ("r16float", 1, T::R16Float, S::R16Float),
            Self::Rg16Float => ("rg16float", 2, T::Rg16Float, S::Rg16Float),
            Self::Rgba16Float => ("rgba16float", 4, T::Rgba16Float, S::Rgba16Float),
            Self::R8Unorm => ("r8unorm", 1, T::R8Unorm, S::R8Unorm),
            Self::Rgba8Unorm => ("rgba8unorm", 4, T::Rgba8Unorm, S::Rgba8Unorm),
            Self::Rgb10a2Unorm => ("rgb10a2unorm", 4, T::Rgb10a2Unorm, S::Rgb10a2Unorm),
            Self::Rg11b10Ufloat => ("rg11b10ufloat", 4, T::Rg11b10Ufloat, S::Rg11b10Ufloat),
        }
    }

    /// Returns its name in filter.toml and in WGSL.
    pub(crate) fn name(self) -> &'static str {
        self.describe().0
    }

    /// Returns how many numbers a texel is passed as.
    pub fn components(self) -> usize {
        self.describe().1
    }

    /// Converts the format to wgpu's.
    pub(crate) fn wgpu(self) -> TextureFormat {
        self.describe().2
    }

    /// Returns the format of a storage texture.
    pub(crate) fn stored(self) -> StorageFormat {
        self.describe().3
    }

    /// Returns the bytes of a texel.
    pub(crate) fn texel_bytes(self) -> u64 {
        let bytes = self.wgpu().block_copy_size(None);
        bytes
            .expect("a texel of a color format has one size")
            .into()
    }

    /// Returns the format with as many 32-bit floats; formats that are not of floats stay.
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

    /// Returns the type of its numbers in shaders that read them: `u32` or `f32`.
    pub(crate) fn kind(self) -> ScalarKind {
        match self {
            Self::R32Uint => ScalarKind::Uint,
            _ => ScalarKind::Float,
        }
    }
}
