//! Passes of a filter, and the textures between them.

use super::pass_shader::PassShader;
use crate::{Expression, Format};

/// Texture that one pass writes for another.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// WGSL variable that reads it; `<name>_out` writes it.
    pub name: String,
    /// Numbers per texel.
    pub format: Format,
    /// Divisors of the image's width and height, of parameters, `width` and `height`; `None` for
    /// the image's own size.
    pub(crate) divided_by: Option<[Expression; 2]>,
    /// Rounding of the quotients.
    pub(crate) rounding: Rounding,
    /// Mip levels, at most as many as there are halvings down to one texel.
    pub mips: u32,
    /// Meaning of its numbers, if a person may want to see them.
    pub holds: Option<Holds>,
}

/// Rounding of the sides of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Rounding {
    /// The last texels cover fewer pixels.
    #[default]
    Up,
    /// The last pixels are left over; at least one texel remains.
    Down,
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
pub(crate) struct Pass {
    /// Name in messages: the entry point of the kernel, or the file of a shader whose entry point
    /// is `main`.
    pub entry: String,
    /// The shader, if the pass names one of its own.
    pub shader: Option<PassShader>,
    /// Indices of the shaders of its stages among those of the filter.
    pub(crate) shaders: Vec<usize>,
    /// Texture whose texels it runs over; `None` for the image's pixels.
    pub over: Option<String>,
    /// True if a whole workgroup runs for each of those texels, instead of one invocation.
    pub workgroup_per_texel: bool,
    /// Number of runs.
    pub repeat: Count,
}

impl Pass {
    /// Lists its render targets, by location; none for a kernel.
    pub fn list_targets(&self) -> impl Iterator<Item = &String> {
        self.shader.iter().flat_map(|shader| &shader.targets)
    }

    /// Names the entry point.
    pub(crate) fn kernel(&self) -> &str {
        match &self.shader {
            Some(shader) => &shader.file.entry,
            None => &self.entry,
        }
    }
}

/// A number of runs or of pixels.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(
    untagged,
    expecting = "a unit or repeat is a count from 1 or the name of an integer parameter"
)]
pub(crate) enum Count {
    /// A fixed number.
    Number(u32),
    /// The value of this integer parameter.
    Parameter(String),
}
