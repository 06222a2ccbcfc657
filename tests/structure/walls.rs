//! The walls between crates, as docs/architecture.md draws them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use toml::Table;

/// Crates that one capability fills: the program names each once, and can do without it.
const CAPABILITIES: [&str; 6] = ["bench", "engine", "gate", "merge", "score", "tune"];

/// Crates, and what each imports of the others.
type Imports = BTreeMap<String, BTreeSet<String>>;

#[test]
fn crates_import_what_the_page_of_the_architecture_says() {
    let drawn = read_page();
    let real = read_manifests();
    let names = |imports: &Imports| imports.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&drawn), names(&real), "a row for each crate");
    for (name, imports) in &real {
        let allowed = reach(&drawn, name);
        let further: Vec<_> = imports.difference(&allowed).collect();
        assert!(
            further.is_empty(),
            "{name} imports {further:?}; docs/architecture.md lets it import {allowed:?}"
        );
        for direct in &drawn[name] {
            assert!(
                reach(&real, name).contains(direct),
                "docs/architecture.md says that {name} imports {direct}"
            );
        }
    }
}

#[test]
fn a_capability_is_imported_by_the_program_alone() {
    for (name, imports) in read_manifests() {
        for capability in CAPABILITIES {
            assert!(
                name == "cli" || !imports.contains(capability),
                "{name} imports {capability}"
            );
        }
    }
}

/// Lists all that a crate imports, and what that imports.
fn reach(imports: &Imports, name: &str) -> BTreeSet<String> {
    let mut reached = BTreeSet::new();
    let mut open = vec![name.to_owned()];
    while let Some(next) = open.pop() {
        for import in &imports[&next] {
            if reached.insert(import.clone()) {
                open.push(import.clone());
            }
        }
    }
    reached
}

/// Reads the table of crates: rows such as "| `tracer` | `scene`, `bvh` | what it is for |".
fn read_page() -> Imports {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/architecture.md");
    let page = fs::read_to_string(page).expect("the page is text");
    let table = page.split("| crate |").nth(1).expect("a table of crates");
    let rows = table
        .lines()
        .skip(2)
        .take_while(|line| line.starts_with('|'));
    let rows: Vec<Vec<&str>> = rows.map(|row| row.split('|').collect()).collect();
    let quoted = |cell: &str| -> Vec<String> {
        let parts = cell.split('`').skip(1).step_by(2);
        parts.map(str::to_owned).collect()
    };
    let names: Vec<String> = rows.iter().flat_map(|row| quoted(row[1])).collect();
    let imports = rows.iter().map(|row| {
        let [name] = quoted(row[1]).try_into().expect("one crate a row");
        let imports = if row[2].contains("all above") {
            let above = names.iter().take_while(|other| **other != name);
            above.cloned().collect()
        } else {
            quoted(row[2]).into_iter().collect()
        };
        (name, imports)
    });
    imports.collect()
}

/// Reads which crates of the workspace each crate imports.
fn read_manifests() -> Imports {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let entries = fs::read_dir(crates).expect("the repository has crates");
    let manifests: Vec<(String, Table)> = entries
        .map(|entry| {
            let folder = entry.expect("a folder");
            let text = fs::read_to_string(folder.path().join("Cargo.toml")).expect("a manifest");
            let name = folder.file_name().into_string().expect("a plain name");
            (name, text.parse().expect("a manifest is TOML"))
        })
        .collect();
    let names: BTreeSet<String> = manifests.iter().map(|(name, _)| name.clone()).collect();
    let imports = manifests.into_iter().map(|(name, manifest)| {
        let kinds = ["dependencies", "build-dependencies"];
        let tables = kinds
            .iter()
            .filter_map(|kind| manifest.get(*kind)?.as_table());
        let listed = tables.flat_map(Table::keys);
        let imports = listed.filter(|other| names.contains(*other)).cloned();
        (name, imports.collect())
    });
    imports.collect()
}
