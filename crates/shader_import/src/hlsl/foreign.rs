//! Files of HLSL that no compiler would understand, each refused with the way out.

use crate::fault::FileFault;
use crate::shader_file::ShaderFile;
use crate::sources::{Sources, find_word};

/// Words of ReShade's effects.
const OF_RESHADE: [&str; 6] = [
    "ReShade",
    "__RESHADE__",
    "ui_type",
    "ui_label",
    "BUFFER_WIDTH",
    "BUFFER_RCP_WIDTH",
];

/// Finds what makes a shader foreign to all compilers.
pub fn find_foreign(sources: &Sources, shader: &ShaderFile) -> Option<FileFault> {
    let (text, file) = (sources.text(), &shader.path);
    let is_effect = shader.path.extension().is_some_and(|ending| ending == "fx");
    if let (true, Some((line, word))) = (is_effect, find_word(text, &OF_RESHADE)) {
        let reason = format!(
            "is an effect of ReShade by its word {word}, and no compiler here reads ReShade's language; write its pixel shader \
             as HLSL in a file .hlsl: Texture2D and SamplerState instead of texture and sampler, and `values` instead of \
             BUFFER_WIDTH and ui_ annotations"
        );
        return Some(sources.fault(file, line, reason));
    }
    let macros = ["CBUFFER_START"];
    let (line, _) = find_word(text, &macros)?;
    let defines = |text: &String| {
        let mut lines = text.lines().map(str::trim);
        lines.any(|line| {
            line.starts_with('#') && line.contains("define") && find_word(line, &macros).is_some()
        })
    };
    (!sources.texts.values().any(defines)).then(|| {
        let reason = "uses CBUFFER_START, a macro that Unity defines in Packages/com.unity.render-pipelines.core/ShaderLibrary/API, \
                      and no file that it includes defines it; name another file, which has `#define CBUFFER_START(name) cbuffer \
                      name {` and `#define CBUFFER_END };` and then includes this one";
        sources.fault(file, line, reason)
    })
}
