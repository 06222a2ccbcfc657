//! The page that lists all limits.

use std::fs;

#[test]
fn the_page_of_limits_agrees_with_the_constants() {
    let read = |path: &str| fs::read_to_string(tests::root().join(path)).unwrap();
    let page = read("docs/limits.md");
    // Each row holds a number, and the constant that defines it as `NAME` in `path`.
    let rows: Vec<Vec<&str>> = (page.lines())
        .filter(|line| line.starts_with("| ") && line.contains("` in `"))
        .map(|line| line.split('|').map(str::trim).collect())
        .collect();
    for row in &rows {
        let place: Vec<&str> = row[4].split('`').collect();
        let (name, path) = (place[1], place[3]);
        let source = read(path);
        let declared = source.split_once(&format!("const {name}:"));
        let (_, rest) = declared.unwrap_or_else(|| panic!("{path} has no constant {name}"));
        let value = rest.split_once('=').unwrap().1.split(';').next().unwrap();
        assert_eq!(
            number(&row[2].replace(',', "")),
            number(value),
            "{name} in {path}"
        );
    }
    let source = read("crates/tracer/src/limits.rs");
    for line in source.lines().filter(|line| line.starts_with("pub const")) {
        let name = line.split([' ', ':']).nth(2).unwrap();
        let named = rows.iter().any(|row| row[4].contains(&format!("`{name}`")));
        assert!(named, "docs/limits.md lacks {name}");
    }
}

/// Parses a product of numbers in Rust's notation, or a shifted 1.
fn number(text: &str) -> f64 {
    let text = text.trim().replace('_', "");
    match text.split_once("<<") {
        Some((one, bits)) => number(one) * number(bits).exp2(),
        None => text
            .split('*')
            .map(|part| part.trim().parse::<f64>().unwrap())
            .product(),
    }
}
