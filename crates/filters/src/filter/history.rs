//! Inputs of the frame before, for filters that declare them.

/// An input of the frame before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum History {
    /// Colour of the frame before, not blurred.
    Color,
    /// Its velocity.
    Velocity,
    /// Its depth.
    Depth,
}

impl History {
    /// Returns the name of the input in filter.toml and shaders.
    pub fn input(self) -> &'static str {
        let texture = self.texture();
        texture.strip_suffix("_before").unwrap_or(texture)
    }

    /// Returns the name of its texture in shaders.
    pub fn texture(self) -> &'static str {
        match self {
            History::Color => "color_before",
            History::Velocity => "velocity_before",
            History::Depth => "depth_before",
        }
    }
}
