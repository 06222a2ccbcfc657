//! Slang: slangc compiles it, and HLSL, to SPIR-V.

use crate::compiler::{Compiler, REGISTERS};
use crate::shader_file::ShaderFile;
use crate::sources::Sources;

/// Way to get slangc.
pub const SLANG_WAY_OUT: &str =
    "install Slang from https://github.com/shader-slang/slang/releases and add it to the PATH";

/// Compilers of Slang.
pub static COMPILERS: [Compiler; 1] = [Compiler {
    program: "slangc",
    arguments: |shader, sources| call_slangc("slang", shader, sources),
    way_out: SLANG_WAY_OUT,
}];

/// Makes the words that slangc gets for a shader in Slang or HLSL.
pub fn call_slangc(language: &str, shader: &ShaderFile, sources: &Sources) -> String {
    let (stage, entry) = (shader.stage.names().long, &shader.entry);
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
