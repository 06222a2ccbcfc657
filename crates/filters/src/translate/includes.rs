//! Files that a shader names in `#include`, and in `import` of Slang.

/// A file that a shader names.
#[derive(Debug, PartialEq)]
pub(super) struct Include {
    /// Line, from 1.
    pub line: usize,
    /// The path as it is written; none where a macro stands for it.
    pub path: Option<String>,
}

/// Words of Slang before the path of a module.
const IMPORTS: [&str; 4] = ["import", "__import", "__include", "implementing"];

/// Lists the files that a text without comments names, as a preprocessor sees them: with lines joined that end with `\`.
pub(super) fn list_includes(text: &str) -> Vec<Include> {
    let mut includes = Vec::new();
    for (line, text) in list_lines(text) {
        let text = text.trim_start_matches('\u{feff}').trim();
        match text.strip_prefix('#').or_else(|| text.strip_prefix("%:")) {
            Some(directive) => includes
                .extend(read_directive(directive.trim_start()).map(|path| Include { line, path })),
            None => includes.extend(list_imports(text).map(|path| Include {
                line,
                path: Some(path),
            })),
        }
    }
    includes
}

/// Reads the path of an `#include`; `None` for another directive.
fn read_directive(directive: &str) -> Option<Option<String>> {
    let rest = (directive.strip_prefix("include")).or_else(|| directive.strip_prefix("import"))?;
    let rest = rest.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || c == '_');
    let quoted = |open, close| Some(rest.trim().strip_prefix(open)?.split_once(close)?.0);
    Some((quoted('"', '"').or(quoted('<', '>'))).map(str::to_owned))
}

/// Lists paths in quotes that follow a word of Slang for modules.
fn list_imports(text: &str) -> impl Iterator<Item = String> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    // Every second piece lies within quotes.
    let pieces: Vec<&str> = text.split('"').collect();
    let pairs = pieces.chunks_exact(2);
    let named = pairs.filter(move |pair| {
        let word = pair[0].trim_end();
        let start = word.trim_end_matches(is_part).len();
        IMPORTS.contains(&&word[start..])
    });
    let paths: Vec<String> = named.map(|pair| pair[1].to_owned()).collect();
    paths.into_iter()
}

/// Lists the lines of a text without comments, each with its number. A line that ends with `\` goes on in the next one, and so does
/// a word of Slang for modules.
fn list_lines(text: &str) -> Vec<(usize, String)> {
    let mut lines: Vec<(usize, String)> = Vec::new();
    let mut goes_on = false;
    for (index, part) in text.split('\n').enumerate() {
        let (part, is_spliced) = match part.strip_suffix('\\') {
            Some(part) => (part, true),
            None => (part, false),
        };
        match lines.last_mut() {
            Some((_, line)) if goes_on => line.push_str(part),
            _ => lines.push((index + 1, part.to_owned())),
        }
        let line = &lines.last().expect("there is a line").1;
        let names_module = IMPORTS.iter().any(|word| line.trim_end().ends_with(word));
        goes_on = is_spliced || (names_module && !line.trim_start().starts_with('#'));
        if goes_on && !is_spliced {
            lines.last_mut().expect("there is a line").1.push(' ');
        }
    }
    lines
}

/// Removes the comments of a text, and keeps its lines. A compiler that reads the result sees what [`list_includes`] saw, even
/// where the two disagree about what is a comment.
pub(super) fn remove_comments(text: &str) -> String {
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let mut plain = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    let mut in_quotes = false;
    while let Some(c) = rest.next() {
        match (c, rest.peek().copied()) {
            ('/', Some('/')) if !in_quotes => {
                let mut last = ' ';
                // A comment goes on behind `\`.
                while let Some(c) = rest.next_if(|c| *c != '\n' || last == '\\') {
                    plain.extend((c == '\n').then_some(c));
                    last = c;
                }
            }
            ('/', Some('*')) if !in_quotes => {
                rest.next();
                plain.push(' ');
                let mut last = ' ';
                for c in rest.by_ref() {
                    plain.extend((c == '\n').then_some(c));
                    if (last, c) == ('*', '/') {
                        break;
                    }
                    last = c;
                }
            }
            ('\\', Some(escaped)) if in_quotes => {
                rest.next();
                plain.extend([c, escaped]);
            }
            _ => {
                in_quotes = c != '\n' && in_quotes ^ (c == '"');
                plain.push(c);
            }
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::{Include, list_includes, remove_comments};

    #[test]
    fn includes_are_found_however_they_are_written() {
        type Found<'a> = &'a [(usize, Option<&'a str>)];
        let cases: [(&str, Found); 16] = [
            ("#include \"a.h\"", &[(1, Some("a.h"))]),
            ("\n  #  include <b/c.h> // why", &[(2, Some("b/c.h"))]),
            (
                "#inc\\\nlude \"a.h\"\n#include \"b.h\"",
                &[(1, Some("a.h")), (3, Some("b.h"))],
            ),
            (
                "/* a\n */ # /* b */ include /**/ \"/etc/x\"",
                &[(1, Some("/etc/x"))],
            ),
            ("%:include \"a.h\"", &[(1, Some("a.h"))]),
            (
                "#import \"a.h\"\r\n#include_next \"b.h\"",
                &[(1, Some("a.h")), (2, Some("b.h"))],
            ),
            ("#define X \"a.h\"\n#include X", &[(2, None)]),
            ("// #include \"a.h\"", &[]),
            (
                "// one \\\n#include \"a.h\"\n#include \"b.h\"",
                &[(3, Some("b.h"))],
            ),
            ("/*\n#include \"a.h\"\n*/\n", &[]),
            (
                "import \"../a.slang\"; import b.c; __include\n\"d\";",
                &[(1, Some("../a.slang")), (1, Some("d"))],
            ),
            ("float important = 1; string s = \"import\";", &[]),
            ("#define A \"//\"\n#include \"b.h\"", &[(2, Some("b.h"))]),
            // An escaped quote does not end the text in quotes.
            (
                "#define A \"\\\"/*\"\n#include \"b.h\"\n/**/",
                &[(2, Some("b.h"))],
            ),
            ("\u{feff}#include \"b.h\"", &[(1, Some("b.h"))]),
            (
                "/\\\n/ #include \"a.h\"\n#include \"b.h\"",
                &[(3, Some("b.h"))],
            ),
        ];
        for (text, expected) in cases {
            let expected: Vec<Include> = (expected.iter())
                .map(|(line, path)| Include {
                    line: *line,
                    path: path.map(str::to_owned),
                })
                .collect();
            assert_eq!(list_includes(&remove_comments(text)), expected, "{text}");
        }
    }
}
