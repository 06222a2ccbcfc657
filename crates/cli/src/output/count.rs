//! Counts in sentences.

/// Counts things: `1 case`, `2 cases`.
pub fn count_text(count: usize, one: &str, many: &str) -> String {
    match count {
        1 => format!("1 {one}"),
        count => format!("{count} {many}"),
    }
}
