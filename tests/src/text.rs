//! Checks of texts, and tables in text.

/// Parts of a message: a list, or one text of them, `part | part`.
pub trait Parts {
    /// Lists the parts.
    fn list(&self) -> Vec<&str>;
}

impl Parts for str {
    fn list(&self) -> Vec<&str> {
        self.split(" | ").collect()
    }
}

impl<T: AsRef<str>> Parts for [T] {
    fn list(&self) -> Vec<&str> {
        self.iter().map(AsRef::as_ref).collect()
    }
}

impl<T: AsRef<str>, const N: usize> Parts for [T; N] {
    fn list(&self) -> Vec<&str> {
        self.as_slice().list()
    }
}

impl<T: AsRef<str>> Parts for Vec<T> {
    fn list(&self) -> Vec<&str> {
        self.as_slice().list()
    }
}

impl<T: Parts + ?Sized> Parts for &T {
    fn list(&self) -> Vec<&str> {
        (**self).list()
    }
}

/// Fails, with the whole text, if it lacks one of `parts`.
#[track_caller]
pub fn assert_contains(text: &str, parts: &(impl Parts + ?Sized)) {
    for part in parts.list() {
        assert!(text.contains(part), "\"{part}\" is missing from:\n{text}");
    }
}

/// Joins the words of a text with single spaces: lines break at the width of the terminal.
pub fn squeeze(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Finds a page's first block of code that begins with this text, including its line of back
/// quotes.
pub fn code_block<'a>(page: &'a str, start: &str) -> &'a str {
    let (_, rest) = page.split_once(start).expect(start);
    rest.split("```").next().unwrap_or_default()
}

/// Reads the rows of a table, `what => part | part`, as pairs.
pub fn read_rows(table: &str) -> Vec<(&str, Vec<&str>)> {
    let rows = table.lines().filter(|line| !line.trim().is_empty());
    let split = |row| str::split_once(row, " => ").unwrap_or_else(|| panic!("no row: {row}"));
    rows.map(split)
        .map(|(what, parts)| (what.trim(), parts.split(" | ").map(str::trim).collect()))
        .collect()
}
