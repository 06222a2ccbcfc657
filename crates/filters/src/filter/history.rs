//! Inputs of the frame before, for filters that declare them.

use super::layer::Layer;

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
    /// Returns the layer that it is of the frame before.
    pub fn layer(self) -> Layer {
        match self {
            History::Color => Layer::Color,
            History::Velocity => Layer::Velocity,
            History::Depth => Layer::Depth,
        }
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

/// Finds the layer that a texture of a shader shows, of this frame or of the one before.
pub(crate) fn find_layer(texture: &str) -> Option<Layer> {
    let before = [History::Color, History::Velocity, History::Depth];
    let before = before.map(|history| (history.texture(), history.layer()));
    let layers = Layer::OF_EVERY_FRAME.into_iter().chain(Layer::FURTHER);
    let known = layers.map(|layer| (layer.name(), layer)).chain(before);
    let mut shown = known.filter(|(name, _)| *name == texture);
    shown.next().map(|(_, layer)| layer)
}
