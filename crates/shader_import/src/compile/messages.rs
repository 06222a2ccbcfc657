//! Messages of a compiler, made short and readable.

use std::path::Path;

/// Most bytes of a compiler's messages that an error shows.
const MAX_MESSAGE_BYTES: usize = 4096;

/// Removes the sequences that colour a terminal.
pub fn remove_colors(said: &str) -> String {
    let mut parts = said.split("\u{1b}[");
    let plain = parts.next().unwrap_or_default().to_owned();
    parts.fold(plain, |plain, part| {
        let end = part.find(|c: char| c.is_ascii_alphabetic());
        plain + end.map_or("", |end| &part[end + 1..])
    })
}

/// Finds the first line that a compiler names, and tidies its messages.
pub fn find_error(
    said: &str,
    input: &Path,
    copies: &Path,
    folder: &Path,
) -> (Option<usize>, String) {
    let name = input.display().to_string();
    let of_line = |line: &str| -> Option<usize> {
        let after = line.split_once(&name)?.1;
        let digits = after.trim_start_matches([':', '(']);
        let end = digits
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(digits.len());
        digits[..end].parse().ok()
    };
    let line = said.lines().find_map(of_line);
    let lines = (said.lines().map(str::trim_end))
        .filter(|line| !line.is_empty() && *line != name)
        .map(|line| line.replace(&copies.display().to_string(), &folder.display().to_string()));
    let lines = lines.map(|line| line.replace('\t', " "));
    (line, shorten(lines.collect()))
}

/// Joins a compiler's messages. If they are too long, lines with errors come first, and the number
/// of omitted lines last.
fn shorten(mut lines: Vec<String>) -> String {
    let mut said = lines.join("\n");
    if said.len() <= MAX_MESSAGE_BYTES {
        return said;
    }
    lines.sort_by_key(|line| !line.to_lowercase().contains("error"));
    said = lines.join("\n");
    let mut ends = (0..=MAX_MESSAGE_BYTES).rev();
    let end = ends.find(|end| said.is_char_boundary(*end));
    said.truncate(end.unwrap_or(0));
    let left = lines.len() - said.lines().count();
    format!("{}\n... {left} more lines", said.trim_end())
}

#[cfg(test)]
mod tests {
    use super::{MAX_MESSAGE_BYTES, shorten};

    #[test]
    fn errors_come_first_in_what_is_cut() {
        let notes = |count: usize| (0..count).map(|n| format!("note {n}: ö{}", "-".repeat(50)));
        let few: Vec<String> = notes(3).chain(["an Error".to_owned()]).collect();
        assert_eq!(shorten(few.clone()), few.join("\n"));
        let many: Vec<String> = notes(500)
            .chain(["E0001: error: no such name".into()])
            .collect();
        let said = shorten(many);
        let start = "E0001: error: no such name\nnote 0: ö---";
        assert!(said.starts_with(start), "{said}");
        assert!(said.len() < MAX_MESSAGE_BYTES + 30);
        assert!(said.ends_with(" more lines"), "{said}");
        // One line that is too long shows its beginning.
        let said = shorten(vec!["ä".repeat(5000), "error".repeat(2000)]);
        assert!(said.starts_with("errorerror"), "{said}");
        assert!(said.ends_with("errore\n... 1 more lines"), "{said}");
    }
}
