//! GLSL as Godot has it: sections, which lines such as `#[compute]` begin, and `#include` without
//! an extension.

use crate::shader_file::Stage;

/// Blanks lines that no compiler knows: marks of sections, sections of other stages, and the place
/// where Godot puts its macros. The numbers of lines hold.
pub fn keep_section(text: &str, stage: Stage) -> String {
    let wanted = match stage {
        Stage::Compute => "compute",
        Stage::Fragment => "fragment",
        Stage::Vertex => "vertex",
    };
    let has_own = text.lines().any(|line| name_section(line) == Some(wanted));
    let mut is_kept = true;
    let lines = text.split('\n').map(|line| match name_section(line) {
        Some(section) => {
            // A file that another one includes may be marked for any stage.
            is_kept = section == wanted || !has_own && section != "versions";
            ""
        }
        None if is_kept && line.trim() != "#VERSION_DEFINES" => line,
        None => "",
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Lets glslangValidator follow `#include`. The numbers of lines hold.
pub fn allow_includes(text: &str) -> String {
    let extension = "#extension GL_GOOGLE_include_directive : enable";
    let lines = text.split('\n').zip(2..).map(|(line, next)| {
        if line.trim_start().starts_with("#version") {
            format!("{line}\n{extension}\n#line {next}")
        } else {
            line.to_owned()
        }
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Returns the name of the section that a line begins.
fn name_section(line: &str) -> Option<&str> {
    let name = line.trim().strip_prefix("#[")?.strip_suffix(']')?;
    Some(name.trim())
}

#[cfg(test)]
mod tests {
    use super::{Stage, keep_section};

    #[test]
    fn each_stage_gets_its_section() {
        let text = "#[versions]\nlines = \"#define LINES\";\n#[ vertex ]\n#version 450\n a\n#[fragment]\n#VERSION_DEFINES\n b";
        let kept = |stage| keep_section(text, stage);
        assert_eq!(kept(Stage::Vertex), "\n\n\n#version 450\n a\n\n\n");
        assert_eq!(kept(Stage::Fragment), "\n\n\n\n\n\n\n b");
        // A text without the stage's own section keeps all others.
        assert_eq!(kept(Stage::Compute), "\n\n\n#version 450\n a\n\n\n b");
    }
}
