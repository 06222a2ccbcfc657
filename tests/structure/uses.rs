//! Paths named in a source text.

/// A name of another module that a module uses or re-exports.
#[derive(Debug, PartialEq, Eq)]
pub struct Use {
    /// The path as written, in parts.
    pub path: Vec<String>,
    /// Its name here.
    pub name: String,
    /// Whether it is a re-export: `pub use`.
    pub is_export: bool,
}

/// Finds all uses, except in code for tests only.
pub fn find_uses(text: &str) -> Vec<Use> {
    let text = strip(text);
    let mut uses = Vec::new();
    let mut other = String::new();
    for statement in text.split_inclusive(';') {
        let start = statement.rfind("\nuse ").max(statement.rfind(" use "));
        let Some((before, tree)) = start.map(|at| statement.split_at(at)) else {
            other += statement;
            continue;
        };
        other += before;
        let word = before.split_whitespace().next_back().unwrap_or_default();
        let is_export = word == "pub" || word.starts_with("pub(") || word.ends_with("super)");
        let tree = tree[" use ".len()..]
            .trim_end_matches(';')
            .replace(" as ", "@");
        let tree: String = tree.split_whitespace().collect();
        uses.extend(expand(&tree).iter().map(|path| parse(path, is_export)));
    }
    let words = other.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':');
    let inner = words.filter(|word| {
        ["crate::", "super::"]
            .iter()
            .any(|root| word.starts_with(root))
    });
    uses.extend(inner.map(|path| parse(path.trim_end_matches(':'), false)));
    uses
}

/// Reads `a::b` or, for `a::b as c`, `a::b@c`.
fn parse(text: &str, is_export: bool) -> Use {
    let (path, name) = text.split_once('@').unwrap_or((text, ""));
    let path: Vec<String> = path.split("::").map(str::to_owned).collect();
    let name = match name {
        "" => path.last().cloned().unwrap_or_default(),
        name => name.to_owned(),
    };
    Use {
        path,
        name,
        is_export,
    }
}

/// Lists the paths of `a::{b, c::{d, e}}`.
fn expand(tree: &str) -> Vec<String> {
    let Some((start, rest)) = tree.split_once('{') else {
        return vec![tree.trim_end_matches("::self").to_owned()];
    };
    let mut depth = 0;
    let parts = rest.strip_suffix('}').unwrap_or(rest).split(|c| {
        depth += i32::from(c == '{') - i32::from(c == '}');
        c == ',' && depth == 0
    });
    let parts = parts.filter(|part| !part.is_empty());
    parts
        .flat_map(|part| expand(&format!("{start}{part}")))
        .collect()
}

/// Removes comments, and everything from `#[cfg(test)]` to its end.
pub fn strip(text: &str) -> String {
    let mut kept = String::from("\n");
    let mut end: Option<usize> = None;
    for line in text.lines() {
        let code = line.split("//").next().unwrap_or_default();
        let indent = line.len() - line.trim_start().len();
        match end {
            Some(test_indent)
                if indent == test_indent && (code.ends_with(';') || code.trim() == "}") =>
            {
                end = None
            }
            Some(_) => {}
            None if code.trim() == "#[cfg(test)]" => end = Some(indent),
            None => kept += &format!("{code}\n"),
        }
    }
    kept
}
