//! Sampling of textures.

/// Reading of a texture between and beyond its texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Sampling {
    /// Between texels.
    pub filter: SamplerFilter,
    /// Between mip levels.
    pub mip_filter: SamplerFilter,
    /// Beyond the border.
    pub wrap: Wrap,
}

impl Default for Sampling {
    fn default() -> Self {
        Self {
            filter: SamplerFilter::Linear,
            mip_filter: SamplerFilter::Nearest,
            wrap: Wrap::Clamp,
        }
    }
}

impl Sampling {
    /// Returns true if it makes values that no texel has.
    pub(crate) fn interpolates(self) -> bool {
        [self.filter, self.mip_filter].contains(&SamplerFilter::Linear)
    }
}

/// Value of a texture between its texels.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub(crate) enum SamplerFilter {
    /// The nearest texel's.
    Nearest,
    /// Interpolated between the four texels around.
    #[default]
    Linear,
}

/// Value of a texture beyond its border.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Wrap {
    /// The border's.
    #[default]
    Clamp,
    /// The other side's.
    Repeat,
    /// The mirrored picture's.
    Mirror,
    /// 0 in all components.
    Border,
}
