//! GLSL of Vulkan, OpenGL and Godot: glslangValidator compiles it to SPIR-V.

mod foreign;
mod godot;
mod opengl;

pub use foreign::find_foreign;
pub use godot::{allow_includes, keep_section};

use crate::compiler::Compiler;
use opengl::is_opengl;

/// Way to get glslangValidator.
pub const GLSLANG_WAY_OUT: &str = "install it, for example: apt-get install glslang-tools (Debian, Ubuntu), dnf install glslang \
                                   (Fedora), pacman -S glslang (Arch)";

/// Compilers of GLSL.
pub static COMPILERS: [Compiler; 1] = [Compiler {
    program: "glslangValidator",
    // GLSL has no other entry point than `main`.
    arguments: |shader, sources| {
        let stage = shader.stage.names().short;
        let relaxed = if is_opengl(sources) {
            "-R --auto-map-bindings --auto-map-locations "
        } else {
            ""
        };
        format!("-V {relaxed}--target-env vulkan1.1 -S {stage} -o {{out}} {{in}}")
    },
    way_out: GLSLANG_WAY_OUT,
}];
