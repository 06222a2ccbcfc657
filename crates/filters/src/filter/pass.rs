//! Passes of a filter, and the textures between them.

use super::reach::Length;
use crate::Format;

/// Texture that one pass writes for another.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// WGSL variable that reads it; `<name>_out` writes it.
    pub name: String,
    /// Numbers per texel.
    pub format: Format,
    /// Divisor of the image's size, rounded up; `None` for the image's own size.
    pub divided_by: Option<Length>,
    /// Meaning of its numbers, where a person may want to see them.
    pub holds: Option<Holds>,
}

/// Meaning of a texture between the passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Holds {
    /// Place that gives the pixel its velocity: x and y in pixels from the image's top left corner.
    Places,
}

/// One kernel, run over a whole texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// Entry point of the kernel; the pass's name in messages.
    pub entry: String,
    /// Texture whose texels it runs over; `None` for the image's pixels.
    pub over: Option<String>,
    /// True if a whole workgroup runs for each of those texels, instead of one invocation.
    pub workgroup_per_texel: bool,
    /// Number of runs.
    pub repeat: Repeat,
}

/// Number of times that a pass runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Repeat {
    /// A fixed number.
    Times(u32),
    /// The value of this integer parameter.
    Parameter(String),
}
