//! The page that lists all limits.

use std::fs;

use tests::root;
use walkdir::WalkDir;

/// Reads the sources of one or all crates.
fn read_sources(crate_name: &str) -> String {
    let files = WalkDir::new(root().join("crates").join(crate_name)).into_iter();
    let paths = files.map(|entry| entry.unwrap().into_path());
    let sources = paths.filter(|path| path.extension().is_some_and(|end| end == "rs"));
    let texts = sources.map(fs::read_to_string);
    texts.collect::<Result<_, _>>().unwrap()
}

/// Finds the value of a constant, named `NAME` or, if several crates have one, `crate::NAME`.
fn find_value(all: &str, constant: &str) -> f64 {
    let find = |source: &str, name: &str| {
        let declared = format!("const {name}:");
        let mut values = source.split(&declared).skip(1);
        let value = values.next().and_then(|rest| {
            let declaration = rest.split(';').next()?;
            declaration.split_once('=').map(|(_, value)| number(value))
        });
        assert!(values.next().is_none(), "{name} is declared twice");
        value.unwrap_or_else(|| panic!("no source has {name}"))
    };
    match constant.split_once("::") {
        Some((crate_name, name)) => find(&read_sources(crate_name), name),
        None => find(all, constant),
    }
}

#[test]
fn the_page_of_limits_agrees_with_the_constants() {
    let page = fs::read_to_string(root().join("docs/limits.md")).unwrap();
    let all = read_sources("");
    let mut listed = Vec::new();
    // Each row has one number for all of its constants, or a range with one constant for either end.
    for row in page.lines().filter(|line| line.ends_with("` |")) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let [_, _, limit, constants, _] = cells[..] else {
            panic!("a row has three cells: {row}");
        };
        let limits: Vec<f64> = limit.split(" to ").map(number).collect();
        let names: Vec<&str> = constants.split(", ").collect();
        assert!(limits.len() == 1 || limits.len() == names.len(), "{row}");
        for (name, limit) in names.into_iter().zip(limits.into_iter().cycle()) {
            let name = name.trim_matches('`');
            assert_eq!(limit, find_value(&all, name), "{name}");
            listed.push(name.rsplit("::").next().unwrap());
        }
    }
    let source = fs::read_to_string(root().join("crates/tracer/src/limits.rs")).unwrap();
    for line in source.lines().filter(|line| line.starts_with("pub const")) {
        let name = line.split([' ', ':']).nth(2).unwrap();
        assert!(listed.contains(&name), "docs/limits.md lacks {name}");
    }
}

/// Parses a product of numbers in Rust's notation, a shifted 1, or a number of KiB, MiB or GiB.
fn number(text: &str) -> f64 {
    let text = text.trim().replace(['_', ','], "");
    for (unit, bits) in [(" KiB", 10.0), (" MiB", 20.0), (" GiB", 30.0)] {
        if let Some(count) = text.strip_suffix(unit) {
            return number(count) * f64::exp2(bits);
        }
    }
    match text.split_once("<<") {
        Some((one, bits)) => number(one) * number(bits).exp2(),
        None => {
            let factors = text.split('*').map(|part| part.trim().parse::<f64>());
            factors.map(Result::unwrap).product()
        }
    }
}
