//! Check that a compiler's input names only files that the program resolved.
//!
//! Compilers and the program may disagree about what is a comment, a text in quotes or the end of a
//! line. So the check asks for words, wherever they are, and refuses what could hide one.

use super::includes::{IMPORTS, ends_with_import, list_lines};
use super::language::Language;

/// Words after `#` that open a file.
const OPENING: [&str; 3] = ["include", "import", "embed"];

/// Words that ask whether a file is there, or that are directives in disguise.
const ASKING: [&str; 3] = ["__has_include", "__has_embed", "_Pragma"];

/// Refuses a plain text that could open files other than those in `resolved`, which are lines of
/// directives. The error has a line.
pub(super) fn check_closed(
    text: &str,
    language: Language,
    resolved: &[usize],
) -> Result<(), (usize, String)> {
    for (index, line) in text.split('\n').enumerate() {
        let number = index + 1;
        if let Some(reason) = find_hidden(line, resolved.contains(&number)) {
            return Err((number, reason));
        }
    }
    let lines = match language {
        Language::Slang | Language::Hlsl => list_lines(text),
        _ => Vec::new(),
    };
    let mut hidden = lines.into_iter().filter_map(|(number, line)| {
        let reason = find_hidden_module(&line)?;
        Some((number, reason))
    });
    hidden.next().map_or(Ok(()), Err)
}

/// Refuses a macro that could open a file, or hide what does.
pub(crate) fn check_macro(name: &str, value: &str) -> Result<(), String> {
    let line = format!("#define {name} {value}");
    if line.contains('\n') {
        return Err("has several lines; allowed: one".into());
    }
    // The rules of Slang hold those of the other languages.
    check_closed(&line, Language::Slang, &[]).map_err(|(_, reason)| reason)
}

/// Finds what may hide a directive, or is one that was not resolved.
fn find_hidden(line: &str, is_resolved: bool) -> Option<String> {
    let is_control = |c: char| c.is_control() && c != '\t';
    if let Some(control) = line.chars().find(|c| is_control(*c)) {
        return Some(format!(
            "holds the control character {}; remove it",
            control.escape_debug()
        ));
    }
    if line.trim_end().ends_with('\\') {
        return Some("ends with \\ and blanks; remove the blanks, or the \\".into());
    }
    // Comments are gone, except those that look like text in quotes.
    let disguises = ["/*", "??=", "??/"];
    let words = disguises.into_iter().chain(ASKING);
    if let Some(word) = words.into_iter().find(|word| line.contains(word)) {
        return Some(format!(
            "holds {word}, which may hide an #include from the check of what a shader reads; write it otherwise"
        ));
    }
    let directives = list_directives(line);
    let pragma = directives.iter().find(|rest| rest.starts_with("pragma"));
    if pragma.is_some_and(|rest| rest.contains("include") || rest.contains("dependency")) {
        return Some("is a #pragma that names files; remove it".into());
    }
    let opens = |rest: &&&str| OPENING.iter().any(|word| rest.starts_with(word));
    let opening = directives.iter().filter(opens).count();
    (opening > usize::from(is_resolved)).then(|| {
        "names a file in a way that the program does not resolve; allowed: #include and the path in quotes, on a line of its own"
            .into()
    })
}

/// Lists what follows each `#` of a line, after its blanks.
fn list_directives(line: &str) -> Vec<&str> {
    let marks = line.match_indices('#').chain(line.match_indices("%:"));
    // `##` joins words.
    let marks = marks.filter(|(at, _)| !line[..*at].ends_with('#'));
    // Compilers accept more blanks than ASCII has.
    let is_blank = |c: char| c.is_whitespace() || !c.is_ascii();
    marks
        .map(|(at, mark)| line[at + mark.len()..].trim_start_matches(is_blank))
        .collect()
}

/// Finds what may form the name of a module of Slang: its words in a macro, and paths in quotes
/// that lead out of a folder. Lines that [`find_hidden`] judges form none, and neither do messages
/// of `#error`.
fn find_hidden_module(line: &str) -> Option<String> {
    let trimmed = line.trim_start();
    let directive = trimmed.strip_prefix('#').or(trimmed.strip_prefix("%:"));
    let names_nothing = |rest: &str| {
        let mut words = OPENING.iter().chain(&["error"]);
        words.any(|word| rest.starts_with(word))
    };
    let directive = directive.map(str::trim_start);
    if directive.is_some_and(names_nothing) {
        return None;
    }
    if let Some(define) = directive.and_then(|rest| rest.strip_prefix("define")) {
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let mut words = define.split(|c| !is_part(c));
        if let Some(word) = words.find(|word| IMPORTS.contains(word)) {
            return Some(format!(
                "makes a macro of `{word}`; write it where the module is needed"
            ));
        }
        if define.replace("##", "").contains('#') {
            return Some(
                "makes text in quotes of a macro's argument; write the text itself".into(),
            );
        }
    }
    // Every second piece is within quotes.
    let pieces: Vec<&str> = line.split('"').collect();
    let mut quoted = pieces
        .chunks(2)
        .filter_map(|pair| Some((pair[0], *pair.get(1)?)));
    let outside = quoted.find(|(before, text)| leads_out(text) && !ends_with_import(before))?;
    Some(format!(
        "holds \"{}\", which looks like a path out of the filter's folder; write it otherwise",
        outside.1
    ))
}

/// Returns true for a text that may be a path out of a folder.
fn leads_out(text: &str) -> bool {
    let mut parts = text.split(['/', '\\']);
    // Windows knows `c:file`.
    let after_drive = text.split_at_checked(1).map(|(_, rest)| rest);
    let is_drive = after_drive
        .and_then(|rest| rest.strip_prefix(':'))
        .is_some_and(|rest| rest.starts_with(|c: char| c.is_alphanumeric() || "/\\.".contains(c)));
    // `\x2e` is a dot, and so is `\56`.
    let plain = text.replace("\\\\", "/");
    let mut escaped = plain.split('\\').skip(1);
    let is_escaped = escaped.any(|rest| !rest.starts_with(['n', 'r', 't', '"']));
    text.starts_with(['/', '\\']) || is_drive || is_escaped || parts.any(|part| part == "..")
}

#[cfg(test)]
mod tests {
    use super::super::includes::make_plain;
    use super::*;

    #[test]
    fn what_could_open_another_file_is_refused() {
        let glsl = [
            // A compiler without text in quotes sees a comment that ends before the directive.
            "#define U \"/*\n\"*/ #include \"/x\"",
            "\" */ #/**/include \"/x\"",
            "\"*/ #/*\n*/ include \"/x\"",
            // Blanks that only some compilers know.
            "#inc\\ \nlude \"/x\"",
            "\u{180e}#include \"/x\"",
            "#\u{a0}include \"/x\"",
            "a %: include \"/x\"",
            "??=include \"/x\"",
            "#inc??/\nlude \"/x\"",
            "#\0include \"/x\"",
            "#if __has_include(\"/x\")",
            "_Pragma(\"once\")",
            "#pragma include_alias(\"own.h\", \"/x\")",
            "# pragma GCC dependency \"/x\"",
            "#embed \"/x\"",
            "# include_next <x>",
        ];
        for text in glsl {
            let plain = make_plain(text);
            let refused = check_closed(&plain, Language::Glsl, &[]);
            assert!(refused.is_err(), "{text:?} becomes {plain:?}");
        }
        let slang = [
            "#define I import\nI \"x\";",
            "# define I __import \"x\"",
            "#define S(x) #x\nimport S(../x);",
            "CAT(im, port) \"../x\";",
            "CAT(im, port) \"/x\";",
            "CAT(im, port) \"a\\\\..\\\\x\";",
            "CAT(im, port) \"\\x2e\\x2e/x\";",
            "CAT(im, port) \"\\56./x\";",
            "CAT(im, port) \"c:x\";",
            "#define myimport CAT(im, port)\nmyimport \"../x\";",
        ];
        for text in slang {
            let plain = make_plain(text);
            for language in [Language::Slang, Language::Hlsl] {
                let refused = check_closed(&plain, language, &[]);
                assert!(refused.is_err(), "{text:?} becomes {plain:?}");
            }
        }
    }

    #[test]
    fn honest_shaders_pass() {
        let shaders = [
            "#version 450\n#extension GL_GOOGLE_include_directive : require\n",
            "// #include \"/x\" \\\n still a comment\n/* #include \"x\" \n */ float a = 2.0 / 3.0;",
            "#define CAT(a, b) a##b\n#define IN(x) x##include_x\n#define TWO(x) \\\n  (x) * \\\n  2\nfloat b = CAT(a, 1); // why",
            "#pragma once\n#pragma kernel CSMain\n#pragma target 3.0\n#pragma multi_compile _ FAST",
            "[shader(\"compute\")] [numthreads(8, 8, 1)] void main() { printf(\"a: %d\\n\", 1); }",
            "#define A 1 /* one\n more */ + 2\n#define B /* to the end",
            "#error \"see https://example.org/x\"\nfloat important; // it's \"quoted\n",
            "import noise; __include \"a/b\"; float c = 1 ? 2 : 3;",
        ];
        for text in shaders {
            for language in [Language::Glsl, Language::Hlsl, Language::Slang] {
                let plain = make_plain(text);
                let checked = check_closed(&plain, language, &[]);
                assert_eq!(checked, Ok(()), "{text:?} becomes {plain:?}");
                assert_eq!(plain.matches('\n').count(), text.matches('\n').count());
            }
        }
        // A resolved line may name one file.
        let include = "#include \"own.h\"";
        assert_eq!(check_closed(include, Language::Glsl, &[1]), Ok(()));
        let twice = "#include \"own.h\" #include \"/x\"";
        assert!(check_closed(twice, Language::Glsl, &[1]).is_err());
    }
}
