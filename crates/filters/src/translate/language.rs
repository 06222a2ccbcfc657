//! Shading languages, by the ending of a file.

use std::path::Path;

/// A shading language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Language {
    Spirv,
    Glsl,
    Slang,
    Hlsl,
    Wesl,
    Wgsl,
}

/// Ending of Unity's ShaderLab, which contains HLSL.
pub(crate) const SHADER_LAB: &str = "shader";

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
    /// Finds the language of a file; fails with what is allowed.
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
