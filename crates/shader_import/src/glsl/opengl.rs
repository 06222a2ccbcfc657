//! GLSL of OpenGL, where uniforms need neither a block nor a binding, and pictures begin at the
//! bottom left.

use crate::sources::Sources;

/// First version of GLSL of OpenGL that has `layout(binding = 0)`.
const WITH_BINDINGS: u32 = 420;

/// Returns true for a shader that declares its uniforms as OpenGL has them and Vulkan does not.
pub(super) fn is_opengl(sources: &Sources) -> bool {
    let version = find_version(sources.text());
    version.is_some_and(|version| version < WITH_BINDINGS)
        || sources.texts.values().any(|text| has_loose_uniform(text))
}

/// Finds the version of OpenGL that a plain text asks for; none for OpenGL ES.
fn find_version(text: &str) -> Option<u32> {
    let mut lines = text
        .lines()
        .map(|line| line.trim().strip_prefix("#version"));
    let mut words = lines.find_map(|line| line)?.split_whitespace();
    let version = words.next()?.parse().ok()?;
    (words.next() != Some("es")).then_some(version)
}

/// Returns true if a plain text declares a uniform without a binding.
fn has_loose_uniform(text: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut declared = text.match_indices("uniform").filter(|(at, word)| {
        let [before, after] = [&text[..*at], &text[at + word.len()..]];
        !before.ends_with(is_part) && after.starts_with(char::is_whitespace)
    });
    declared.any(|(at, _)| {
        // The qualifiers of a declaration are between the end of the previous one and the word.
        let start = text[..at].rfind([';', '}', '#']).map_or(0, |end| end + 1);
        let mut words = text[start..at].split(|c| !is_part(c));
        !words.any(|word| ["binding", "set", "push_constant", "define"].contains(&word))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniforms_without_a_binding_are_loose() {
        for (text, is_loose) in [
            ("#version 450\nuniform sampler2D color;", true),
            ("layout(std140) uniform Block { float a; };", true),
            (
                "layout(binding = 0) uniform sampler2D color;\nuniform\nfloat x;",
                true,
            ),
            (
                "layout(set = 1, binding = 0, rgba16f) restrict uniform image2D a;",
                false,
            ),
            (
                "layout(push_constant, std430) uniform Parameters { vec2 a; } b;",
                false,
            ),
            ("float uniformity = 0.0; float my_uniform = 1.0;", false),
            ("#define U(n) layout(binding = n) uniform sampler2D", false),
        ] {
            assert_eq!(has_loose_uniform(text), is_loose, "{text}");
        }
    }

    #[test]
    fn versions_of_opengl_are_found() {
        assert_eq!(find_version("\n #version 330 core\n"), Some(330));
        assert_eq!(find_version("#version 310 es\n"), None);
        assert_eq!(find_version("void main() {}"), None);
    }
}
