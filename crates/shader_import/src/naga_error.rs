//! Messages of naga.

/// Joins the messages of an error and of its causes.
pub fn explain(error: &dyn std::error::Error) -> String {
    let mut said = error.to_string();
    let mut cause = error.source();
    while let Some(inner) = cause {
        said += &format!(": {inner}");
        cause = inner.source();
    }
    said.replace('\n', " ")
}

/// Removes the word "error" before a message of naga, and blanks at the ends of its lines.
pub fn tidy(message: &str) -> String {
    let message = message.strip_prefix("error: ").unwrap_or(message);
    let lines = message.trim_end().lines().map(str::trim_end);
    lines.collect::<Vec<_>>().join("\n").replace('\t', " ")
}
