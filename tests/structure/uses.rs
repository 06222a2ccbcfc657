//! The paths that a source names, found in its text.

/// A name of another module that a module uses or re-exports.
#[derive(Debug, PartialEq, Eq)]
pub struct Use {
    /// The path as it is written, in parts.
    pub path: Vec<String>,
    /// The name that it has here.
    pub name: String,
    /// Whether it is a re-export: `pub use`.
    pub is_export: bool,
}

/// Finds all uses, except in code that only tests have.
pub fn find_uses(text: &str) -> Vec<Use> {
    let text = strip(text);
    let mut uses = Vec::new();
    let mut other = String::new();
    for statement in text.split_inclusive(';') {
        let start = ["\nuse ", " use "]
            .iter()
            .filter_map(|it| statement.rfind(it))
            .max();
        let Some((before, tree)) = start.map(|at| statement.split_at(at)) else {
            other += statement;
            continue;
        };
        other += before;
        let word = before.split_whitespace().next_back().unwrap_or_default();
        let is_export = word == "pub" || word.starts_with("pub(") || word.ends_with("super)");
        let tree: String = tree[" use ".len()..]
            .trim_end_matches(';')
            .replace(" as ", "@");
        let tree: String = tree.split_whitespace().collect();
        uses.extend(expand(&tree).iter().map(|path| parse(path, is_export)));
    }
    let words = other.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':');
    let inner = words.filter(|word| word.starts_with("crate::") || word.starts_with("super::"));
    uses.extend(inner.map(|path| parse(path.trim_end_matches(':'), false)));
    uses
}

/// Reads `a::b` or, for `a::b as c`, `a::b@c`.
fn parse(text: &str, is_export: bool) -> Use {
    let (path, name) = text.split_once('@').unwrap_or((text, ""));
    let path: Vec<String> = path.split("::").map(str::to_owned).collect();
    let own = path.last().cloned().unwrap_or_default();
    let name = match name {
        "" => own,
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
    let inner = rest.strip_suffix('}').unwrap_or(rest);
    let mut paths = Vec::new();
    let (mut depth, mut from) = (0, 0);
    for (at, c) in inner.char_indices().chain([(inner.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let part = &inner[from..at];
                from = at + 1;
                if !part.is_empty() {
                    let whole = format!("{start}{part}");
                    paths.extend(expand(&whole));
                }
            }
            _ => {}
        }
    }
    paths
}

/// Removes comments, and what follows `#[cfg(test)]` up to its end.
fn strip(text: &str) -> String {
    let mut kept = String::from("\n");
    let mut end: Option<usize> = None;
    for line in text.lines() {
        let code = line.split("//").next().unwrap_or_default();
        let indent = line.len() - line.trim_start().len();
        match end {
            Some(own) => {
                if indent == own && (code.ends_with(';') || code.trim() == "}") {
                    end = None;
                }
            }
            None if code.trim() == "#[cfg(test)]" => end = Some(indent),
            None => {
                kept += code;
                kept.push('\n');
            }
        }
    }
    kept
}
