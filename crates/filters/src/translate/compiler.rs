//! Compilers of shading languages, and their command lines.

use super::language::Language;
use super::opengl::is_opengl;
use super::sources::Sources;
use crate::filter::{PassShader, Stage};

/// A compiler of one language.
#[derive(Debug)]
pub(crate) struct Compiler {
    pub program: &'static str,
    /// Makes the words that it gets for a shader and its texts; `{in}`, `{out}` and `{include}`
    /// stand for files.
    pub(super) arguments: fn(&PassShader, &Sources) -> String,
    /// Way to get it.
    pub way_out: &'static str,
}

/// First bindings of the registers of HLSL: `b0`, `t0`, `u0` and `s0` are different things.
const REGISTERS: &str =
    "-fvk-b-shift 0 all -fvk-t-shift 100 all -fvk-u-shift 200 all -fvk-s-shift 300 all";

const GLSLANG_WAY_OUT: &str = "install it, for example: apt-get install glslang-tools (Debian, Ubuntu), dnf install glslang \
                               (Fedora), pacman -S glslang (Arch)";
const SLANG_WAY_OUT: &str =
    "install Slang from https://github.com/shader-slang/slang/releases and add it to the PATH";

static OF_GLSL: [Compiler; 1] = [Compiler {
    program: "glslangValidator",
    // GLSL has no other entry point than `main`.
    arguments: |shader, sources| {
        let [short, ..] = name_stage(shader);
        let relaxed = if is_opengl(sources) {
            "-R --auto-map-bindings --auto-map-locations "
        } else {
            ""
        };
        format!("-V {relaxed}--target-env vulkan1.1 -S {short} -o {{out}} {{in}}")
    },
    way_out: GLSLANG_WAY_OUT,
}];

static OF_SLANG: [Compiler; 1] = [Compiler {
    program: "slangc",
    arguments: |shader, sources| call_slangc("slang", shader, sources),
    way_out: SLANG_WAY_OUT,
}];

static OF_HLSL: [Compiler; 3] = [
    Compiler {
        program: "slangc",
        arguments: |shader, sources| call_slangc("hlsl", shader, sources),
        way_out: SLANG_WAY_OUT,
    },
    Compiler {
        program: "dxc",
        arguments: |shader, _| {
            let ([_, _, profile], entry) = (name_stage(shader), &shader.entry);
            format!(
                "-spirv -fspv-target-env=vulkan1.1 -T {profile} -E {entry} {REGISTERS} -Fo {{out}} {{in}}"
            )
        },
        way_out: "install dxc from https://github.com/microsoft/DirectXShaderCompiler/releases and add it to the PATH",
    },
    Compiler {
        program: "glslangValidator",
        arguments: |shader, _| {
            let ([short, ..], entry) = (name_stage(shader), &shader.entry);
            // The shifts are those of `REGISTERS`.
            format!(
                "-D -V --target-env vulkan1.1 -S {short} -e {entry} --auto-map-bindings --auto-map-locations --stb 100 \
                 --sbb 100 --sib 200 --ssb 300 -o {{out}} {{in}}"
            )
        },
        way_out: GLSLANG_WAY_OUT,
    },
];

static OF_WESL: [Compiler; 1] = [Compiler {
    program: "wesl",
    arguments: |shader, _| {
        let conditions = shader.conditions.iter().map(|name| format!("-D {name} "));
        format!("compile {}{{in}}", conditions.collect::<String>())
    },
    way_out: "install it with: cargo install wesl-cli@0.4.0",
}];

impl Language {
    /// Returns the programs that compile it, the best first; none for a language that needs no
    /// compiler.
    pub fn compilers(self) -> &'static [Compiler] {
        match self {
            Self::Glsl => &OF_GLSL,
            Self::Slang => &OF_SLANG,
            Self::Hlsl => &OF_HLSL,
            Self::Wesl => &OF_WESL,
            Self::Spirv | Self::Wgsl => &[],
        }
    }
}

/// Names the stage of a shader as glslangValidator, slangc and dxc do.
fn name_stage(shader: &PassShader) -> [&'static str; 3] {
    match shader.stage {
        Stage::Compute => ["comp", "compute", "cs_6_0"],
        Stage::Fragment => ["frag", "fragment", "ps_6_0"],
        Stage::Vertex => ["vert", "vertex", "vs_6_0"],
    }
}

fn call_slangc(language: &str, shader: &PassShader, sources: &Sources) -> String {
    let ([_, stage, _], entry) = (name_stage(shader), &shader.entry);
    // With shifts of registers, slangc ignores bindings of Vulkan.
    let registers = if sources.text().contains("vk::binding") {
        ""
    } else {
        REGISTERS
    };
    format!(
        "{{include}} -lang {language} {{in}} -target spirv -profile spirv_1_3 -entry {entry} -stage {stage} \
         -fvk-use-entrypoint-name {registers} -o {{out}}"
    )
}
