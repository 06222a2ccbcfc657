//! WESL: wesl compiles it to WGSL.

mod packages;

pub use packages::name_packages;

use crate::compiler::Compiler;

/// Compilers of WESL.
pub static COMPILERS: [Compiler; 1] = [Compiler {
    program: "wesl",
    arguments: |shader, _| {
        let conditions = shader.conditions.iter().map(|name| format!("-D {name} "));
        format!("compile {}{{in}}", conditions.collect::<String>())
    },
    way_out: "install it with: cargo install wesl-cli@0.4.0",
}];
