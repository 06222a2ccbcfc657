//! Tables of tests in TOML files: what is tried, and the program's expected messages.

/// Reads the rows of a table, with a static lifetime.
pub fn rows(toml: &str, table: &str) -> Vec<Vec<&'static str>> {
    let tables: toml::Table = toml.parse().unwrap();
    let rows: Vec<Vec<String>> = tables[table].clone().try_into().unwrap();
    assert!(!rows.is_empty(), "{table} has no rows");
    let leak = |row: Vec<String>| row.into_iter().map(|text| &*text.leak());
    rows.into_iter().map(|row| leak(row).collect()).collect()
}

/// Divides a row into changes, each `from => to`, and the required words of an error.
pub fn divide(row: &[&'static str]) -> (Vec<(&'static str, &'static str)>, Vec<&'static str>) {
    let (changes, words): (Vec<&str>, Vec<&str>) =
        row.iter().partition(|text| text.contains(" => "));
    let change = |text: &'static str| text.split_once(" => ").unwrap();
    (changes.into_iter().map(change).collect(), words)
}
