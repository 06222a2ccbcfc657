//! Texels of textures, as filter.toml and kernels declare them.

/// Texel format: numbers of 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// One whole number from 0.
    R32Uint,
    /// One number.
    R32Float,
    /// Two numbers.
    Rg32Float,
    /// Four numbers.
    Rgba32Float,
}

impl Format {
    /// Returns how many numbers a texel holds.
    pub(crate) fn components(self) -> usize {
        match self {
            Format::R32Uint | Format::R32Float => 1,
            Format::Rg32Float => 2,
            Format::Rgba32Float => 4,
        }
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
            Format::R32Float | Format::Rg32Float | Format::Rgba32Float => Texel::Float,
        }
    }
}
