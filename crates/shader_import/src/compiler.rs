//! A compiler of a shading language, and its command line.

use crate::shader_file::{ShaderFile, Stage};
use crate::sources::Sources;

/// A compiler of one language.
#[derive(Debug)]
pub struct Compiler {
    /// The program, by its name on the PATH.
    pub program: &'static str,
    /// Makes the words that it gets for a shader and its texts; `{in}`, `{out}` and `{include}`
    /// stand for files.
    pub(crate) arguments: fn(&ShaderFile, &Sources) -> String,
    /// Way to get it.
    pub(crate) way_out: &'static str,
}

/// First bindings of the registers of HLSL: `b0`, `t0`, `u0` and `s0` are different things.
pub const REGISTERS: &str =
    "-fvk-b-shift 0 all -fvk-t-shift 100 all -fvk-u-shift 200 all -fvk-s-shift 300 all";

/// Names of a stage.
pub struct StageNames {
    /// As glslangValidator has it.
    pub short: &'static str,
    /// As slangc has it.
    pub long: &'static str,
    /// As dxc has it.
    pub profile: &'static str,
}

impl Stage {
    /// Names the stage as compilers do.
    pub(crate) fn names(self) -> StageNames {
        let [short, long, profile] = match self {
            Self::Compute => ["comp", "compute", "cs_6_0"],
            Self::Fragment => ["frag", "fragment", "ps_6_0"],
            Self::Vertex => ["vert", "vertex", "vs_6_0"],
        };
        StageNames {
            short,
            long,
            profile,
        }
    }
}
