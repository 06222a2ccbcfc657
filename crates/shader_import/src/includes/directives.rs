//! Files that a shader names in `#include`, and in `import` of Slang.

/// A file that a shader names.
#[derive(Debug, PartialEq)]
pub struct Include {
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
pub fn list_includes(text: &str) -> Vec<Include> {
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

#[cfg(test)]
mod tests {
    use super::super::plain_text::make_plain;
    use super::list_includes;

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
