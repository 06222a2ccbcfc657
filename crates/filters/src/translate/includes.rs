//! Files that a shader names in `#include`, and in `import` of Slang.

/// A file that a shader names.
#[derive(Debug, PartialEq)]
pub(super) struct Include {
    /// Line, from 1.
    pub line: usize,
    /// The path as it is written; none if a macro names it.
    pub path: Option<String>,
    /// True for a module of Slang.
    pub is_module: bool,
}

/// Words of Slang before the path of a module.
const IMPORTS: [&str; 4] = ["import", "__import", "__include", "implementing"];

/// Lists the files that a plain text names.
pub(super) fn list_includes(text: &str) -> Vec<Include> {
    let mut includes = Vec::new();
    for (line, text) in list_lines(text) {
        let text = text.trim();
        match text.strip_prefix('#').or_else(|| text.strip_prefix("%:")) {
            Some(directive) => {
                let path = read_directive(directive.trim_start());
                includes.extend(path.map(|path| Include {
                    line,
                    path,
                    is_module: false,
                }));
            }
            None => includes.extend(list_imports(text).map(|path| Include {
                line,
                path: Some(path),
                is_module: true,
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
    // Every second piece is within quotes.
    let pieces: Vec<&str> = text.split('"').collect();
    let pairs = pieces.chunks_exact(2);
    let named = pairs.filter(|pair| ends_with_import(pair[0]));
    let paths: Vec<String> = named.map(|pair| pair[1].to_owned()).collect();
    paths.into_iter()
}

/// Returns true for text before the path of a module.
fn ends_with_import(text: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let text = text.trim_end();
    let start = text.trim_end_matches(is_part).len();
    IMPORTS.contains(&&text[start..])
}

/// Lists the lines of a plain text, each with its number. An import of Slang continues on the next
/// line.
fn list_lines(text: &str) -> Vec<(usize, String)> {
    let mut lines: Vec<(usize, String)> = Vec::new();
    let mut goes_on = false;
    for (index, part) in text.split('\n').enumerate() {
        match lines.last_mut() {
            Some((_, line)) if goes_on => line.extend([" ", part]),
            _ => lines.push((index + 1, part.to_owned())),
        }
        let line = &lines.last().expect("there is a line").1;
        let names_module = IMPORTS.iter().any(|word| line.trim_end().ends_with(word));
        goes_on = names_module && !line.trim_start().starts_with('#');
    }
    lines
}

/// Makes the text that a compiler gets, and that [`list_includes`] reads: lines that end with `\`
/// are joined, comments are removed, and lines keep their numbers. So both see the same includes.
pub(super) fn make_plain(text: &str) -> String {
    let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n");
    let text = text.replace(['\u{b}', '\u{c}'], " ");
    let plain = remove_comments(&join_lines(&text.replace('\r', "\n")));
    let lines = plain.split('\n').map(drop_file_name);
    lines.collect::<Vec<_>>().join("\n")
}

/// Shortens `#line 3 "file"` to `#line 3`, so that no compiler looks for files next to that one.
fn drop_file_name(line: &str) -> &str {
    let directive = line.trim_start().strip_prefix('#').map(str::trim_start);
    let is_number =
        |rest: &str| rest.starts_with("line") || rest.starts_with(|c: char| c.is_ascii_digit());
    match (directive.is_some_and(is_number), line.find('"')) {
        (true, Some(at)) => &line[..at],
        _ => line,
    }
}

/// Joins lines that end with `\`. Empty lines follow, so that the others keep their numbers.
fn join_lines(text: &str) -> String {
    let mut joined = String::with_capacity(text.len());
    let mut pending = 0;
    for line in text.split_inclusive('\n') {
        match line.strip_suffix("\\\n") {
            Some(start) => {
                joined.push_str(start);
                pending += 1;
            }
            None => {
                joined.push_str(line);
                joined.extend(std::iter::repeat_n('\n', pending));
                pending = 0;
            }
        }
    }
    joined
}

/// Removes the comments of a text of joined lines, and keeps its lines. A directive continues after
/// a comment of several lines, and the comment's empty lines follow it.
fn remove_comments(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut pending = 0;
    let mut rest = text.chars().peekable();
    let mut in_quotes = false;
    while let Some(c) = rest.next() {
        match (c, rest.peek().copied()) {
            ('/', Some('/')) if !in_quotes => while rest.next_if(|c| *c != '\n').is_some() {},
            ('/', Some('*')) if !in_quotes => {
                rest.next();
                plain.push(' ');
                let line = plain.rsplit('\n').next().unwrap_or_default();
                let is_directive = line.trim_start().starts_with(['#', '%']);
                let mut last = ' ';
                for c in rest.by_ref() {
                    match (c, is_directive) {
                        ('\n', true) => pending += 1,
                        ('\n', false) => plain.push(c),
                        _ => {}
                    }
                    if (last, c) == ('*', '/') {
                        break;
                    }
                    last = c;
                }
            }
            ('\\', Some(escaped)) if in_quotes && escaped != '\n' => {
                rest.next();
                plain.extend([c, escaped]);
            }
            _ => {
                in_quotes = c != '\n' && in_quotes ^ (c == '"');
                plain.push(c);
                if c == '\n' {
                    plain.extend(std::iter::repeat_n('\n', std::mem::take(&mut pending)));
                }
            }
        }
    }
    plain.extend(std::iter::repeat_n('\n', pending));
    plain
}

#[cfg(test)]
mod tests {
    use super::{list_includes, make_plain};

    #[test]
    fn includes_are_found_however_they_are_written() {
        type Found<'a> = &'a [(usize, Option<&'a str>)];
        let cases: [(&str, Found); 17] = [
            ("#include \"a.h\"", &[(1, Some("a.h"))]),
            ("\n  #  include <b/c.h> // why", &[(2, Some("b/c.h"))]),
            (
                "#inc\\\nlude \"a.h\"\n#include \"b.h\"",
                &[(1, Some("a.h")), (3, Some("b.h"))],
            ),
            (
                "/* a\n */ # /* b */ include /**/ \"/etc/x\"",
                &[(2, Some("/etc/x"))],
            ),
            (
                "# /* a\n */ include \"a.h\"\n#include \"b.h\"",
                &[(1, Some("a.h")), (3, Some("b.h"))],
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
            let includes = list_includes(&make_plain(text));
            let places = includes
                .iter()
                .map(|include| (include.line, include.path.as_deref()));
            assert_eq!(places.collect::<Vec<_>>(), expected, "{text}");
        }
    }
}
