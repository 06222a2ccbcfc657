//! Layers of a frame that filters may read.

/// A layer of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// Scene-linear colour.
    Color,
    /// Screen motion.
    Velocity,
    /// Distance along the view axis.
    Depth,
    /// Screen motion from the instant to one frame later.
    VelocityNext,
    /// Change of depth.
    VelocityZ,
    /// Mask of what a blur leaves alone.
    Exclusion,
}

impl Layer {
    /// Layers that every frame has.
    pub(crate) const OF_EVERY_FRAME: [Self; 3] = [Self::Color, Self::Velocity, Self::Depth];

    /// Layers that a filter gets if one of its shaders reads them: few frames have them.
    pub(crate) const FURTHER: [Self; 3] = [Self::VelocityNext, Self::VelocityZ, Self::Exclusion];

    /// Lists names.
    pub(crate) fn list_names(layers: [Self; 3]) -> String {
        layers.map(Self::name).join(", ")
    }

    /// Returns its name in filter.toml, in shaders and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Color => "color",
            Self::Velocity => "velocity",
            Self::Depth => "depth",
            Self::VelocityNext => "velocity_next",
            Self::VelocityZ => "velocity_z",
            Self::Exclusion => EXCLUSION,
        }
    }
}

/// The layer that marks what a blur leaves alone.
pub const EXCLUSION: &str = "exclusion";
