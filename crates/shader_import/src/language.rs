//! Shading languages, by the ending of a file.

use std::path::Path;

use crate::fault::FileFault;
use crate::shader_file::ShaderFile;

/// A shading language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// SPIR-V of Vulkan.
    Spirv,
    /// GLSL of Vulkan or OpenGL.
    Glsl,
    /// Slang.
    Slang,
    /// HLSL, Unreal's and Unity's too.
    Hlsl,
    /// WESL.
    Wesl,
    /// WGSL.
    Wgsl,
}

/// Ending of Unity's ShaderLab, which contains HLSL.
pub const SHADER_LAB: &str = "shader";

/// Endings of files.
const ENDINGS: [(&str, Language); 13] = [
    ("spv", Language::Spirv),
    ("glsl", Language::Glsl),
    ("comp", Language::Glsl),
    ("frag", Language::Glsl),
    ("vert", Language::Glsl),
    ("slang", Language::Slang),
    ("hlsl", Language::Hlsl),
    ("fx", Language::Hlsl),
    ("usf", Language::Hlsl),
    ("ush", Language::Hlsl),
    (SHADER_LAB, Language::Hlsl),
    ("wesl", Language::Wesl),
    ("wgsl", Language::Wgsl),
];

impl Language {
    /// Finds the language of a file.
    ///
    /// # Errors
    /// Its ending is unknown; the message says which are allowed.
    pub fn of(file: &Path) -> Result<Self, String> {
        let ending = file.extension().and_then(|ending| ending.to_str());
        let known = ENDINGS.iter().find(|(known, _)| Some(*known) == ending);
        known.map(|(_, language)| *language).ok_or_else(|| {
            let allowed: Vec<String> = ENDINGS
                .iter()
                .map(|(ending, _)| format!(".{ending}"))
                .collect();
            format!(
                "\"{}\" has no ending of a known language; allowed: {}",
                file.display(),
                allowed.join(", ")
            )
        })
    }

    /// Finds the language of a shader, which is at a path.
    pub(crate) fn of_shader(shader: &ShaderFile, path: &Path) -> Result<Self, FileFault> {
        Self::of(&shader.path).map_err(|reason| FileFault::new(path, None, reason))
    }

    /// Names the language in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Spirv => "SPIR-V",
            Self::Glsl => "GLSL",
            Self::Slang => "Slang",
            Self::Hlsl => "HLSL",
            Self::Wesl => "WESL",
            Self::Wgsl => "WGSL",
        }
    }
}
