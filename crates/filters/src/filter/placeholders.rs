//! Placeholders: names in braces that stand for files and values in the arguments of a command.

/// Placeholders for the frame. Every parameter of the filter is a placeholder, too.
pub(crate) const PLACEHOLDERS: [&str; 5] = [
    "frame",
    "out",
    "exposure",
    "frame_index",
    "frames_per_second",
];

/// Replaces each `{name}` in a word by `value(name)`, and `{{` and `}}` by braces. The error says
/// which name has no value, or that a brace is unmatched.
pub(crate) fn fill_placeholders(
    word: &str,
    mut value: impl FnMut(&str) -> Option<String>,
) -> Result<String, String> {
    let mut filled = String::new();
    let mut rest = word;
    while let Some(at) = rest.find(['{', '}']) {
        let (before, brace) = rest.split_at(at);
        filled += before;
        rest = if let Some(after) = brace.strip_prefix("{{") {
            filled.push('{');
            after
        } else if let Some(after) = brace.strip_prefix("}}") {
            filled.push('}');
            after
        } else {
            let (name, after) = (brace.strip_prefix('{'))
                .and_then(|inside| inside.split_once('}'))
                .ok_or("has a brace without the other")?;
            filled += &value(name).ok_or_else(|| format!("holds the unknown {{{name}}}"))?;
            after
        };
    }
    Ok(filled + rest)
}

#[cfg(test)]
mod tests {
    use super::fill_placeholders;

    #[test]
    fn names_in_braces_are_replaced_and_nothing_else() {
        for (word, expected) in [
            ("", ""),
            ("--shutter", "--shutter"),
            ("{exposure}", "0.5"),
            ("-e{exposure}/{exposure}s", "-e0.5/0.5s"),
            ("{{exposure}}", "{exposure}"),
            ("{{{exposure}}}", "{0.5}"),
            ("größe={exposure}", "größe=0.5"),
        ] {
            let filled =
                fill_placeholders(word, |name| (name == "exposure").then(|| "0.5".to_owned()));
            assert_eq!(filled.as_deref(), Ok(expected), "{word}");
        }
    }
}
