//! Lines of engines' code that results/findings quote, and the script that compares them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use tests::root;
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, python_with, stderr, stdout};

/// Runs examples/fidelity/quotes.py.
fn compare(clones: &Path, pages: &[&Path]) -> Output {
    let mut command = Command::new(python_with(&["argparse"]));
    command
        .arg("-B")
        .arg(root().join("examples/fidelity/quotes.py"));
    command.arg("--clones").arg(clones).args(pages);
    command.output().unwrap()
}

/// Runs git in a folder; returns what it prints.
fn git(folder: &Path, words: &str) -> String {
    let mut command = Command::new("git");
    command.args(["-c", "user.name=x", "-c", "user.email=x@example.org", "-C"]);
    let output = command.arg(folder).args(words.split(' ')).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    stdout(&output).trim().to_owned()
}

/// Makes the clone `clones/owner/name` of one file; returns its commit.
fn make_clone(sandbox: &Sandbox) -> String {
    let blur = "int a = 1;\n\tint b = a | 2;\n";
    sandbox.put("clones/owner/name/blur.c", blur);
    let clone = sandbox.path("clones/owner/name");
    git(&clone, "init -q");
    git(&clone, "add .");
    git(&clone, "commit -q -m first");
    git(&clone, "rev-parse HEAD")
}

#[test]
fn a_quote_is_the_line_that_it_names() {
    let sandbox = Sandbox::new();
    let commit = make_clone(&sandbox);
    let page = sandbox.path("page.md");
    let head = format!("| line of `owner/name` at {commit} | code |\n|---|---|\n");
    let check = |text: String, code: i32, expected: &[&str]| {
        fs::write(&page, text).unwrap();
        let output = compare(&sandbox.path("clones"), &[&page]);
        let printed = format!("{}{}", stdout(&output), stderr(&output));
        assert_eq!(output.status.code(), Some(code), "{printed}");
        assert_contains(&printed, expected);
    };
    let row = |cells: &str| format!("# Page\n\n{head}{cells}\n\nMore.\n");
    // A bar in a table is written with a backslash.
    let code = "int b = a \\| 2;";
    let right = row(&format!("| `blur.c:2` | `{code}` |"));
    check(right.clone(), 0, &["1 of 1 quotes compared"]);
    let refused: [(&str, &str, &[&str]); 5] = [
        (
            "blur.c:1",
            code,
            &[
                "page.md: owner/name at ",
                "blur.c:1: quoted `int b = a | 2;`, found 'int a = 1;'",
            ],
        ),
        ("blur.c:2", "int b", &["found 'int b = a | 2;'"]),
        ("blur.c:9", "x", &["no line: the file has 2"]),
        ("other.c:1", "x", &["no file"]),
        ("blur.c", "x", &["page.md:5: write"]),
    ];
    for (place, quoted, expected) in refused {
        check(row(&format!("| `{place}` | `{quoted}` |")), 1, expected);
    }
    let elsewhere = right.replace("owner/name", "owner/none");
    check(elsewhere, 1, &["nothing was compared", "owner/none"]);
    check(right.replace(&commit, "1234567"), 1, &["page.md:3: write"]);
}

/// Returns the text below each heading of the second level.
fn sections(page: &str) -> Vec<(&str, &str)> {
    let parts = page.split("\n## ").skip(1);
    parts.filter_map(|part| part.split_once('\n')).collect()
}

#[test]
fn every_engine_has_lines_of_the_commit_that_its_preset_names() {
    let sandbox = Sandbox::new();
    let listing = sandbox.execute(&["list", "--json"]);
    let listing: Value = serde_json::from_str(&listing).unwrap();
    let filters = listing["filters"].as_array().unwrap();
    let presets = filters.iter().flat_map(|filter| {
        let presets = filter["presets"].as_array().unwrap().iter();
        presets.map(move |preset| (&filter["name"], preset))
    });
    let commit = |ships: &str| {
        let (filter, preset) = ships.split_once(':').unwrap();
        let mut presets = presets.clone();
        let pair = presets.find(|(name, table)| *name == filter && table["name"] == preset);
        let source = &pair.expect(ships).1["source"];
        source["commit"].as_str().map(str::to_owned)
    };
    let read = |below: &str| fs::read_to_string(root().join(below)).unwrap();
    let engines: toml::Table = read("results/engines.toml").parse().unwrap();
    let page = read("results/findings/shipped.md");
    let sections = sections(&page);
    for engine in engines["engine"].as_array().unwrap() {
        let [name, ships, listed_commit] =
            ["name", "shape", "commit"].map(|key| engine[key].as_str().unwrap());
        let section = sections.iter().find(|(heading, _)| *heading == name);
        let (_, text) = section.unwrap_or_else(|| panic!("shipped.md has no section {name}"));
        let commit = commit(ships).unwrap_or_else(|| listed_commit.to_owned());
        assert!(
            commit.starts_with(listed_commit),
            "{name}: {listed_commit}, {ships}: {commit}"
        );
        assert!(
            text.contains(&format!("at {commit}")),
            "{name}: no line of {commit}, the commit of {ships}"
        );
        let state = ["On", "Off", "Added"].map(|word| text.trim_start().starts_with(word));
        assert!(state.contains(&true), "{name}: on, off or added?");
    }
}

#[test]
fn the_quotes_of_all_findings_can_be_compared() {
    let sandbox = Sandbox::new();
    let folder = fs::read_dir(root().join("results/findings")).unwrap();
    let pages: Vec<_> = folder.map(|entry| entry.unwrap().path()).collect();
    let pages: Vec<&Path> = pages.iter().map(AsRef::as_ref).collect();
    let is_page = |page: &&Path| page.extension().is_some_and(|extension| extension == "md");
    let pages: Vec<&Path> = pages.into_iter().filter(is_page).collect();
    // Without clones it compares nothing, but refuses tables of another form.
    let output = compare(&sandbox.path("nowhere"), &pages);
    assert_contains(&stderr(&output), &["nothing was compared"]);
    let printed = stdout(&output);
    let counts = printed.strip_prefix("0 of ").unwrap();
    let count: usize = counts.split(' ').next().unwrap().parse().unwrap();
    assert!(count > 80, "{count} quotes");
}
