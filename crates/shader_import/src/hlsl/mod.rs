//! HLSL, Unreal's and Unity's too: slangc, dxc or glslangValidator compiles it to SPIR-V.

mod foreign;
mod shader_lab;
mod unreal;

pub use foreign::find_foreign;
pub use shader_lab::cut_hlsl;
pub use unreal::{refuse_if_used, strip_root};

use crate::compiler::{Compiler, REGISTERS};
use crate::glsl::GLSLANG_WAY_OUT;
use crate::slang::{SLANG_WAY_OUT, call_slangc};

/// Compilers of HLSL, the best first.
pub static COMPILERS: [Compiler; 3] = [
    Compiler {
        program: "slangc",
        arguments: |shader, sources| call_slangc("hlsl", shader, sources),
        way_out: SLANG_WAY_OUT,
    },
    Compiler {
        program: "dxc",
        arguments: |shader, _| {
            let (profile, entry) = (shader.stage.names().profile, &shader.entry);
            format!(
                "-spirv -fspv-target-env=vulkan1.1 -T {profile} -E {entry} {REGISTERS} -Fo {{out}} {{in}}"
            )
        },
        way_out: "install dxc from https://github.com/microsoft/DirectXShaderCompiler/releases and add it to the PATH",
    },
    Compiler {
        program: "glslangValidator",
        arguments: |shader, _| {
            let (stage, entry) = (shader.stage.names().short, &shader.entry);
            // The shifts are those of `REGISTERS`.
            format!(
                "-D -V --target-env vulkan1.1 -S {stage} -e {entry} --auto-map-bindings --auto-map-locations --stb 100 \
                 --sbb 100 --sib 200 --ssb 300 -o {{out}} {{in}}"
            )
        },
        way_out: GLSLANG_WAY_OUT,
    },
];
