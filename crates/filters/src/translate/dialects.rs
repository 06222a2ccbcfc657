//! Shaders that look like a known language and are not, each refused with the way out.

use std::path::Path;

use super::language::Language;
use super::opengl::is_opengl;
use super::sources::Sources;
use crate::filter::{PassShader, VerticalDirection};
use crate::{Convention, FilterError};

/// Words of HLSL that no GLSL has.
const OF_HLSL: [&str; 5] = [
    "cbuffer",
    "Texture2D",
    "RWTexture2D",
    "SamplerState",
    "numthreads",
];

/// Words of ReShade's effects.
const OF_RESHADE: [&str; 6] = [
    "ReShade",
    "__RESHADE__",
    "ui_type",
    "ui_label",
    "BUFFER_WIDTH",
    "BUFFER_RCP_WIDTH",
];

/// Refuses a shader whose compiler would say only that it does not understand it, or that would be
/// read the wrong way up.
pub(super) fn check_dialect(
    sources: &Sources,
    shader: &PassShader,
    convention: &Convention,
) -> Result<(), FilterError> {
    let refused = match sources.language {
        Language::Glsl => find_foreign_glsl(sources, &shader.file, convention),
        Language::Hlsl => find_foreign_hlsl(sources, shader),
        _ => None,
    };
    match refused {
        None => Ok(()),
        Some((line, reason)) => {
            let path = sources.folder.join(&shader.file);
            Err(FilterError::in_file(&path, line, reason))
        }
    }
}

/// Line of a shader, if one says it, and why it is refused.
type Refused = (Option<usize>, String);

fn find_foreign_glsl(sources: &Sources, file: &Path, convention: &Convention) -> Option<Refused> {
    let text = sources.text();
    let foreign_word = find_word(text, &OF_HLSL).or_else(|| {
        let semantic = |word: &&str| word.starts_with("SV_");
        find(text, semantic)
    });
    if let (Some((line, word)), None) = (foreign_word, find_word(text, &["version"])) {
        let ending = file.extension().unwrap_or_default().to_string_lossy();
        let reason = format!(
            "is HLSL by its word {word}, and .{ending} is an ending of GLSL; name the file .hlsl, and its `entry` and `stage` \
             in filter.toml"
        );
        return Some((Some(line), reason));
    }
    if let (Some((line, _)), None) = (find_word(text, &["mainImage"]), find_word(text, &["main"])) {
        let reason = "has mainImage, where Shadertoy begins, and no main; name another file, which declares iResolution and \
                      iChannel0, includes this one, and calls mainImage(color, gl_FragCoord.xy) from its main";
        return Some((Some(line), reason.into()));
    }
    if convention.origin.is_some() {
        return None;
    }
    if is_opengl(sources) {
        let reason = "is GLSL of OpenGL, by its #version or by a uniform without a binding, and OpenGL's pictures begin at the \
                      bottom left; write origin = \"bottom_left\" in [convention], or \"top_left\" if its engine turns \
                      them over";
        return Some((None, reason.to_owned()));
    }
    // With bindings, GLSL of OpenGL looks like Vulkan's.
    let (line, _) = find_word(text, &["gl_FragCoord"])?;
    (convention.velocity_y == Some(VerticalDirection::Up)).then(|| {
        let reason = "has gl_FragCoord, and [convention] has velocity_y = \"up\" and no origin; write origin = \"bottom_left\" if \
                      it is of OpenGL, where both count from the bottom, or \"top_left\"";
        (Some(line), reason.to_owned())
    })
}

fn find_foreign_hlsl(sources: &Sources, shader: &PassShader) -> Option<Refused> {
    let text = sources.text();
    let is_effect = shader.file.extension().is_some_and(|ending| ending == "fx");
    if let (true, Some((line, word))) = (is_effect, find_word(text, &OF_RESHADE)) {
        let reason = format!(
            "is an effect of ReShade by its word {word}, and no compiler here reads ReShade's language; write its pixel shader \
             as HLSL in a file .hlsl: Texture2D and SamplerState instead of texture and sampler, and `values` instead of \
             BUFFER_WIDTH and ui_ annotations"
        );
        return Some((Some(line), reason));
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
        (Some(line), reason.to_owned())
    })
}

/// Finds the first of these words in a plain text, and its line, from 1.
fn find_word<'t>(text: &'t str, words: &[&str]) -> Option<(usize, &'t str)> {
    find(text, |word| words.contains(word))
}

fn find<'t>(text: &'t str, is_wanted: impl Fn(&&'t str) -> bool) -> Option<(usize, &'t str)> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let lines = text.lines().zip(1..);
    lines
        .flat_map(|(line, number)| {
            let words = line.split(move |c| !is_part(c));
            words.map(move |word| (number, word))
        })
        .find(|(_, word)| is_wanted(word))
}
