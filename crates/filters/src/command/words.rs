//! Names in braces, which stand for files and values in the arguments of a command.

/// What stands for something of the frame; every parameter of the filter has its own name beside these.
pub(crate) const PLACEHOLDERS: [&str; 4] = ["frame", "out", "exposure", "frame_index"];

/// The word with `value(name)` in the place of each `{name}`; `{{` and `}}` are braces. Says what is wrong with a name
/// that has no value, and with a brace that has no other.
pub(crate) fn fill(
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
    use super::fill;

    fn filled(word: &str) -> Result<String, String> {
        fill(word, |name| (name == "exposure").then(|| "0.5".to_owned()))
    }

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
            assert_eq!(filled(word).as_deref(), Ok(expected), "{word}");
        }
    }

    #[test]
    fn unknown_names_and_lone_braces_are_refused() {
        for (word, says) in [
            ("{shutter}", "holds the unknown {shutter}"),
            ("{}", "holds the unknown {}"),
            ("{ exposure }", "holds the unknown { exposure }"),
            ("{exposure", "has a brace without the other"),
            ("exposure}", "has a brace without the other"),
        ] {
            assert_eq!(filled(word), Err(says.to_owned()), "{word}");
        }
    }
}
