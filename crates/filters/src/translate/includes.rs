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

/// Lists the files that a text names, as a preprocessor sees them: without comments, and with lines joined that end with `\`.
pub(super) fn list_includes(text: &str) -> Vec<Include> {
    let mut includes = Vec::new();
    for (line, text) in list_lines(text) {
        let text = text.trim();
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
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let mut lines = vec![(1, String::new())];
    let mut number = 1;
    let mut rest = text.chars().peekable();
    let mut in_quotes = false;
    while let Some(c) = rest.next() {
        let next = rest.peek().copied();
        let line = &mut lines.last_mut().expect("there is a line").1;
        match (c, next) {
            ('\\', Some('\n')) => {
                rest.next();
                number += 1;
            }
            ('\n', _) => {
                number += 1;
                in_quotes = false;
                let goes_on = IMPORTS.iter().any(|word| line.trim_end().ends_with(word));
                match goes_on && !line.trim_start().starts_with('#') {
                    true => line.push(' '),
                    false => lines.push((number, String::new())),
                }
            }
            ('/', Some('/')) if !in_quotes => {
                while let Some(c) = rest.next_if(|c| *c != '\n') {
                    // A comment goes on as well.
                    if c == '\\' && rest.next_if_eq(&'\n').is_some() {
                        number += 1;
                    }
                }
            }
            ('/', Some('*')) if !in_quotes => {
                rest.next();
                let mut last = ' ';
                for c in rest.by_ref() {
                    number += usize::from(c == '\n');
                    if (last, c) == ('*', '/') {
                        break;
                    }
                    last = c;
                }
                line.push(' ');
            }
            _ => {
                in_quotes ^= c == '"';
                line.push(c);
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::{Include, list_includes};

    /// A text, and the lines and paths of what it includes.
    type Case<'a> = (&'a str, &'a [(usize, Option<&'a str>)]);

    #[test]
    fn includes_are_found_however_they_are_written() {
        let cases: [Case; 13] = [
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
        ];
        for (text, expected) in cases {
            let expected: Vec<Include> = (expected.iter())
                .map(|(line, path)| Include {
                    line: *line,
                    path: path.map(str::to_owned),
                })
                .collect();
            assert_eq!(list_includes(text), expected, "{text}");
        }
    }
}
