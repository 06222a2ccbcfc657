//! The GitHub action and the release archive: pages and files describe them correctly.

use std::collections::BTreeMap;
use std::fs;

use tests::root;

use crate::links::find_pages;

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}

/// Reads the inputs or the outputs of action.yml, each with its lines.
fn read_section(section: &str) -> BTreeMap<String, Vec<String>> {
    let action = read("action.yml");
    let (_, rest) = action.split_once(&format!("\n{section}:\n")).unwrap();
    let body = rest.lines();
    let body = body.take_while(|line| line.is_empty() || line.starts_with(' '));
    let mut entries: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut name = String::new();
    for line in body {
        let head = line.strip_prefix("  ");
        if let Some(head) = head.filter(|head| !head.starts_with(' ')) {
            head.trim_end_matches(':').clone_into(&mut name);
        }
        let lines = entries.entry(name.clone()).or_default();
        lines.push(line.trim().to_owned());
    }
    entries
}

/// Reads the first two cells of each row of the table below a line that begins with `first`.
fn read_table(page: &str, first: &str) -> BTreeMap<String, String> {
    let rows = page.lines().skip_while(|line| !line.starts_with(first));
    let rows = rows.skip(2).take_while(|line| line.starts_with('|'));
    let cells = rows.map(|row| {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        (cells[1].replace('`', ""), cells[2].to_owned())
    });
    cells.collect()
}

#[test]
fn the_page_on_ci_lists_the_inputs_and_outputs_of_the_action_and_the_defaults() {
    let page = read("crates/gate/guides/ci.md");
    for (section, first) in [("inputs", "| input |"), ("outputs", "| output |")] {
        let (said, declared) = (read_table(&page, first), read_section(section));
        assert!(declared.len() > 3);
        let (declared, said): (Vec<_>, Vec<_>) = (declared.keys().collect(), said.keys().collect());
        assert_eq!(declared, said, "the {section}");
    }
    let table = read_table(&page, "| input |");
    for (name, lines) in read_section("inputs") {
        let default = lines.iter().find_map(|line| line.strip_prefix("default: "));
        let said = match default.map(|text| text.trim_matches('\'')) {
            None => {
                let is_required = lines.iter().any(|line| line == "required: true");
                assert!(is_required, "{name} has no default");
                "required".to_owned()
            }
            Some("") => "-".to_owned(),
            Some(text) => format!("`{text}`"),
        };
        assert_eq!(table[&name], said, "the default of {name} on the page");
    }
}

#[test]
fn no_script_of_the_action_has_an_expression_in_its_text() {
    // GitHub inserts the value into the script itself, where it would be executed: it belongs into
    // `env`.
    let action = read("action.yml");
    let mut script = None;
    for (number, line) in action.lines().enumerate() {
        let indentation = line.len() - line.trim_start().len();
        if line.trim() == "run: |" {
            script = Some(indentation);
        } else if script.is_some_and(|indent| indentation <= indent && !line.is_empty()) {
            script = None;
        }
        let is_safe = script.is_none() || !line.contains("${{");
        assert!(is_safe, "action.yml:{}: {line}", number + 1);
    }
}

#[test]
fn cargo_binstall_looks_for_the_archive_by_its_name() {
    let manifest: toml::Table = read("crates/cli/Cargo.toml").parse().unwrap();
    let binstall = &manifest["package"]["metadata"]["binstall"];
    let script = read("release/archive.sh");
    assert!(script.contains("name=shuttertruth-$version-$target\n"));
    let name = "shuttertruth-{ version }-{ target }";
    let url = binstall["pkg-url"].as_str().unwrap();
    let end = format!("/v{{ version }}/{name}.tar.gz");
    assert!(url.ends_with(&end), "{url}");
    let folder = format!("{name}/shuttertruth{{ binary-ext }}");
    assert_eq!(binstall["bin-dir"].as_str().unwrap(), folder);
}

#[test]
fn the_citation_has_the_version_of_the_package() {
    let version = env!("CARGO_PKG_VERSION");
    let citation = read("CITATION.cff");
    assert!(
        citation.contains(&format!("\nversion: {version}\n")),
        "{citation}"
    );
}

#[test]
fn no_page_leads_to_an_address_that_does_not_exist() {
    let pages = find_pages(&root());
    assert!(pages.len() > 50, "{}", pages.len());
    for page in pages {
        let text = fs::read_to_string(&page).unwrap();
        assert!(!text.contains("OWNER/"), "{}", page.display());
    }
}
