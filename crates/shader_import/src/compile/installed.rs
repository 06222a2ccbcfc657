//! Compilers of each language, and those that are installed.

use std::path::Path;

use crate::compiler::Compiler;
use crate::fault::FileFault;
use crate::language::Language;
use crate::shader_file::ShaderFile;
use crate::{glsl, hlsl, slang, wesl};

impl Language {
    /// Returns the programs that compile it, the best first; none for a language that needs no
    /// compiler.
    pub fn compilers(self) -> &'static [Compiler] {
        match self {
            Self::Glsl => &glsl::COMPILERS,
            Self::Slang => &slang::COMPILERS,
            Self::Hlsl => &hlsl::COMPILERS,
            Self::Wesl => &wesl::COMPILERS,
            Self::Spirv | Self::Wgsl => &[],
        }
    }
}

/// Lists the compilers of a pass that are installed, the best first: all of its language, or the
/// one that it chose.
pub fn list_installed(
    language: Language,
    shader: &ShaderFile,
    path: &Path,
) -> Result<Vec<&'static Compiler>, FileFault> {
    let known = language.compilers();
    let is_chosen = |compiler: &&Compiler| shader.compiler.as_deref() == Some(compiler.program);
    // A vertex stage may have another language.
    let wanted: Vec<&Compiler> = match known.iter().find(is_chosen) {
        Some(chosen) => vec![chosen],
        None => known.iter().collect(),
    };
    let installed = wanted.iter().copied();
    let installed: Vec<&Compiler> = installed
        .filter(|compiler| is_installed(compiler.program))
        .collect();
    if !installed.is_empty() {
        return Ok(installed);
    }
    let (becomes, ending) = match language {
        Language::Wesl => ("WGSL", "wgsl"),
        _ => ("SPIR-V", "spv"),
    };
    let programs: Vec<&str> = wanted.iter().map(|compiler| compiler.program).collect();
    Err(FileFault::new(
        path,
        None,
        format!(
            "{} needs {} on the PATH, which is not there; {}; or compile it to {becomes} elsewhere and name the \
             .{ending} file in filter.toml",
            language.name(),
            programs.join(" or "),
            wanted.last().map_or("", |last| last.way_out),
        ),
    ))
}

fn is_installed(program: &str) -> bool {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let endings = ["", ".exe"];
    std::env::split_paths(&folders)
        .any(|folder| (endings.iter()).any(|end| folder.join(format!("{program}{end}")).is_file()))
}
