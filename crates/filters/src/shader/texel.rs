//! Texels of textures, as filter.toml and kernels declare them.

use serde::{Deserialize, Serialize};
use wgpu::TextureFormat;
use wgpu::naga::{Scalar, ScalarKind, StorageFormat};

/// Declares the formats: each with its name in filter.toml and in WGSL, and how many numbers a
/// texel is given as.
macro_rules! formats {
    ($($format:ident $word:ident $components:literal,)*) => {
        /// Texel format, named as in WGSL.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "lowercase")]
        pub enum Format {
            $(
                #[doc = concat!("`", stringify!($word), "`")]
                $format,
            )*
        }

        impl Format {
            /// Every format.
            pub(crate) const ALL: &[Self] = &[$(Self::$format),*];

            /// Returns its name, how many numbers a texel is given as, and its formats as a texture
            /// and as a storage texture.
            fn describe(self) -> (&'static str, usize, TextureFormat, StorageFormat) {
                match self {
                    $(Self::$format => {
                        (stringify!($word), $components, TextureFormat::$format, StorageFormat::$format)
                    })*
                }
            }
        }
    };
}

formats! {
    R8Unorm r8unorm 1, Rg8Unorm rg8unorm 2, Rgba8Unorm rgba8unorm 4,
    R8Uint r8uint 1, Rg8Uint rg8uint 2, Rgba8Uint rgba8uint 4,
    R8Sint r8sint 1, Rg8Sint rg8sint 2, Rgba8Sint rgba8sint 4,
    R16Uint r16uint 1, Rg16Uint rg16uint 2, Rgba16Uint rgba16uint 4,
    R16Sint r16sint 1, Rg16Sint rg16sint 2, Rgba16Sint rgba16sint 4,
    R16Float r16float 1, Rg16Float rg16float 2, Rgba16Float rgba16float 4,
    R32Uint r32uint 1, Rg32Uint rg32uint 2, Rgba32Uint rgba32uint 4,
    R32Sint r32sint 1, Rg32Sint rg32sint 2, Rgba32Sint rgba32sint 4,
    R32Float r32float 1, Rg32Float rg32float 2, Rgba32Float rgba32float 4,
    Rgb10a2Unorm rgb10a2unorm 4, Rg11b10Ufloat rg11b10ufloat 4,
}

impl Format {
    /// Lists the names of all formats.
    pub(crate) fn list(separator: &str) -> String {
        let names = Self::ALL.iter().map(|format| format.name());
        names.collect::<Vec<_>>().join(separator)
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

    /// Returns the kind of its numbers where a shader reads them.
    pub(crate) fn kind(self) -> ScalarKind {
        Scalar::from(self.stored()).kind
    }
}
