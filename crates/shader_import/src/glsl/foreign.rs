//! Files of GLSL that glslangValidator would not understand, or would read the wrong way up, each
//! refused with the way out.

use super::opengl::is_opengl;
use crate::fault::FileFault;
use crate::shader_file::{Pictures, ShaderFile};
use crate::sources::{Sources, find_word, find_word_if};

/// Words of HLSL that no GLSL has.
const OF_HLSL: [&str; 5] = [
    "cbuffer",
    "Texture2D",
    "RWTexture2D",
    "SamplerState",
    "numthreads",
];

/// Finds what makes a shader foreign to its compiler.
pub fn find_foreign(
    sources: &Sources,
    shader: &ShaderFile,
    pictures: Pictures,
) -> Option<FileFault> {
    let (text, file) = (sources.text(), &shader.path);
    let foreign_word =
        find_word(text, &OF_HLSL).or_else(|| find_word_if(text, |word| word.starts_with("SV_")));
    if let (Some((line, word)), None) = (foreign_word, find_word(text, &["version"])) {
        let ending = file.extension().unwrap_or_default().to_string_lossy();
        let reason = format!(
            "is HLSL by its word {word}, and .{ending} is an ending of GLSL; name the file .hlsl, and its `entry` and `stage` \
             in filter.toml"
        );
        return Some(sources.fault(file, line, reason));
    }
    if let (Some((line, _)), None) = (find_word(text, &["mainImage"]), find_word(text, &["main"])) {
        let reason = "has mainImage, where Shadertoy begins, and no main; name another file, which declares iResolution and \
                      iChannel0, includes this one, and calls mainImage(color, gl_FragCoord.xy) from its main";
        return Some(sources.fault(file, line, reason));
    }
    if pictures.have_origin {
        return None;
    }
    if is_opengl(sources) {
        let reason = "is GLSL of OpenGL, by its #version or by a uniform without a binding, and OpenGL's pictures begin at the \
                      bottom left; write origin = \"bottom_left\" in [convention], or \"top_left\" if its engine turns \
                      them over";
        return Some(sources.fault(file, None, reason));
    }
    // With bindings, GLSL of OpenGL looks like Vulkan's.
    let (line, _) = find_word(text, &["gl_FragCoord"])?;
    pictures.velocity_is_up.then(|| {
        let reason = "has gl_FragCoord, and [convention] has velocity_y = \"up\" and no origin; write origin = \"bottom_left\" if \
                      it is of OpenGL, where both count from the bottom, or \"top_left\"";
        sources.fault(file, line, reason)
    })
}
