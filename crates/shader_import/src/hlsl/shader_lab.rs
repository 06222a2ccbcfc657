//! Unity's ShaderLab: the HLSL of one pass of a `.shader` file.

use std::ops::Range;

use crate::shader_file::LabPass;

/// Words before HLSL that every pass shares, and before the HLSL of one pass.
const SHARED: [&str; 2] = ["HLSLINCLUDE", "CGINCLUDE"];
const PROGRAM: [&str; 2] = ["HLSLPROGRAM", "CGPROGRAM"];
const ENDS: [&str; 2] = ["ENDHLSL", "ENDCG"];

/// Parts of a file with HLSL, by their lines.
#[derive(Default)]
struct Parts {
    shared: Vec<Range<usize>>,
    /// Every pass with its name and its HLSL, empty if it has neither.
    passes: Vec<(String, Range<usize>)>,
}

/// Blanks every line but the HLSL that all passes share and the HLSL of one pass, so that line
/// numbers stay valid. Fails if that pass is missing, or if none is named and there are several.
pub fn cut_hlsl(text: &str, wanted: Option<&LabPass>) -> Result<String, String> {
    let parts = find_parts(text)?;
    // Other engines have HLSL alone in files with this ending.
    if parts.passes.is_empty() && wanted.is_none() {
        return Ok(text.to_owned());
    }
    let is_wanted = |(index, (name, _)): &(usize, &(String, Range<usize>))| match wanted {
        Some(LabPass::Name(wanted)) => name == wanted,
        Some(LabPass::Place(wanted)) => index == wanted,
        None => true,
    };
    let mut chosen = parts.passes.iter().enumerate().filter(is_wanted);
    let (Some((_, (_, program))), None) = (chosen.next(), chosen.next()) else {
        let passes = parts.passes.iter().enumerate();
        let passes: Vec<String> = passes
            .map(|(index, (name, _))| format!("{index} \"{name}\""))
            .collect();
        let reason = match wanted {
            Some(LabPass::Name(name)) => {
                format!("shader_pass = \"{name}\" is not one of its passes")
            }
            Some(LabPass::Place(place)) => {
                format!("shader_pass = {place} is not one of its passes")
            }
            None => "it has several passes, and shader_pass names none".to_owned(),
        };
        return Err(format!(
            "{reason}; allowed, by place or by name: {}",
            passes.join(", ")
        ));
    };
    let kept = |line: &usize| {
        parts
            .shared
            .iter()
            .chain([program])
            .any(|part| part.contains(line))
    };
    let lines = text.lines().enumerate();
    let lines = lines.map(|(index, line)| if kept(&index) { line } else { "" });
    Ok(lines.collect::<Vec<_>>().join("\n"))
}

fn find_parts(text: &str) -> Result<Parts, String> {
    let mut parts = Parts::default();
    let mut lines = text.lines().enumerate();
    while let Some((index, line)) = lines.next() {
        let line = line.split("//").next().unwrap_or_default();
        let words: Vec<&str> = line
            .split(|c: char| c.is_whitespace() || "{}".contains(c))
            .collect();
        let has = |known: &[&str]| words.iter().any(|word| known.contains(word));
        if has(&["Pass"]) {
            parts.passes.push(Default::default());
        }
        if has(&["Name"])
            && let (Some((name, _)), Some(quoted)) =
                (parts.passes.last_mut(), line.split('"').nth(1))
        {
            quoted.clone_into(name);
        }
        if !has(&SHARED) && !has(&PROGRAM) {
            continue;
        }
        let is_end = |line: &str| ENDS.contains(&line.trim());
        let (end, _) = lines.find(|(_, line)| is_end(line)).ok_or_else(|| {
            format!(
                "line {}: its HLSL has no end; allowed: a line {}",
                index + 1,
                ENDS.join(" or ")
            )
        })?;
        match parts.passes.last_mut() {
            Some((_, program)) if has(&PROGRAM) => *program = index + 1..end,
            _ => parts.shared.push(index + 1..end),
        }
    }
    Ok(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "Shader \"Blur\" { SubShader {\nHLSLINCLUDE\nfloat shared;\nENDHLSL\nPass { // Pass\nName \"First\"\n\
                        HLSLPROGRAM\nfirst\nENDHLSL\n}\nPass\n{\nCGPROGRAM\nsecond\nENDCG\n} } }";

    #[test]
    fn the_hlsl_of_one_pass_keeps_its_lines() {
        let named = LabPass::Name("First".into());
        let first = cut_hlsl(FILE, Some(&named)).unwrap();
        assert_eq!(first, "\n\nfloat shared;\n\n\n\n\nfirst\n\n\n\n\n\n\n\n");
        let second = cut_hlsl(FILE, Some(&LabPass::Place(1))).unwrap();
        assert_eq!(second, "\n\nfloat shared;\n\n\n\n\n\n\n\n\n\n\nsecond\n\n");
        for wanted in [
            None,
            Some(&LabPass::Place(2)),
            Some(&LabPass::Name("Third".into())),
        ] {
            let refusal = cut_hlsl(FILE, wanted).unwrap_err();
            assert!(
                refusal.ends_with("allowed, by place or by name: 0 \"First\", 1 \"\""),
                "{refusal}"
            );
        }
        assert_eq!(
            cut_hlsl("float4 alone;\n", None).unwrap(),
            "float4 alone;\n"
        );
        let open = FILE.replace("ENDCG", "");
        let refusal = cut_hlsl(&open, None).unwrap_err();
        assert!(
            refusal.starts_with("line 13: its HLSL has no end"),
            "{refusal}"
        );
    }
}
