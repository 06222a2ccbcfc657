//! Compilers of shading languages, and the words that they are called with.

use super::language::Language;
use crate::filter::{PassShader, Stage};

/// First bindings of the registers of HLSL: `b0`, `t0`, `u0` and `s0` are different things.
const REGISTERS: &str =
    "-fvk-b-shift 0 all -fvk-t-shift 100 all -fvk-u-shift 200 all -fvk-s-shift 300 all";

/// The same for glslangValidator.
const GLSLANG_REGISTERS: &str = "--stb 100 --sib 200 --ssb 300";

/// Largest module that is read.
pub(super) const MAX_MODULE_BYTES: u64 = 4 << 20;

/// A compiler, as it is called for one shader.
pub(super) struct Compiler {
    pub program: &'static str,
    /// Words; `{in}`, `{out}` and `{include}` stand for files.
    pub arguments: Vec<String>,
    /// Way to get it.
    pub way_out: &'static str,
}

const GLSLANG_WAY_OUT: &str = "install it, for example: apt-get install glslang-tools (Debian, Ubuntu), dnf install glslang \
                               (Fedora), pacman -S glslang (Arch)";

impl Compiler {
    fn new(program: &'static str, words: &str, way_out: &'static str) -> Self {
        Self {
            program,
            arguments: words.split_whitespace().map(str::to_owned).collect(),
            way_out,
        }
    }

    /// Returns the compilers of a language, the best first, as `Language::compilers` names them. `text` is that of the shader.
    pub fn list(language: Language, shader: &PassShader, text: &str) -> Vec<Self> {
        let entry = &shader.entry;
        let (short, stage, profile) = match shader.stage {
            Stage::Compute => ("comp", "compute", "cs_6_0"),
            Stage::Fragment => ("frag", "fragment", "ps_6_0"),
            Stage::Vertex => ("vert", "vertex", "vs_6_0"),
        };
        // With shifts of registers, slangc overlooks bindings of Vulkan.
        let registers = match text.contains("vk::binding") {
            true => "",
            false => REGISTERS,
        };
        let slang = |language: &str| {
            Self::new(
                "slangc",
                &format!(
                    "{{include}} -lang {language} {{in}} -target spirv -profile spirv_1_3 -entry {entry} -stage {stage} \
                     -fvk-use-entrypoint-name {registers} -o {{out}}"
                ),
                "install Slang from https://github.com/shader-slang/slang/releases and add it to the PATH",
            )
        };
        match language {
            // GLSL knows no other entry point than `main`.
            Language::Glsl => vec![Self::new(
                "glslangValidator",
                &format!("-V --target-env vulkan1.1 -S {short} -o {{out}} {{in}}"),
                GLSLANG_WAY_OUT,
            )],
            Language::Slang => vec![slang("slang")],
            Language::Hlsl => vec![
                slang("hlsl"),
                Self::new(
                    "dxc",
                    &format!(
                        "-spirv -fspv-target-env=vulkan1.1 -T {profile} -E {entry} {REGISTERS} -Fo {{out}} {{in}}"
                    ),
                    "install dxc from https://github.com/microsoft/DirectXShaderCompiler/releases and add it to the PATH",
                ),
                Self::new(
                    "glslangValidator",
                    &format!(
                        "-D -V --target-env vulkan1.1 -S {short} -e {entry} --auto-map-bindings \
                         --auto-map-locations {GLSLANG_REGISTERS} -o {{out}} {{in}}"
                    ),
                    GLSLANG_WAY_OUT,
                ),
            ],
            Language::Wesl => {
                let conditions = shader.conditions.iter().map(|name| format!(" -D {name}"));
                let conditions: String = conditions.collect();
                vec![Self::new(
                    "wesl",
                    &format!("compile{conditions} {{in}}"),
                    "install it with: cargo install wesl-cli@0.4.0",
                )]
            }
            Language::Spirv | Language::Wgsl => Vec::new(),
        }
    }
}
