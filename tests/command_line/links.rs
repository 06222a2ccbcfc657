//! Links between the project's own pages. Each leads to a file, and to a heading if it names one.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use tests::root;
use walkdir::{DirEntry, WalkDir};

/// Folders without our own pages.
const FOREIGN: [&str; 4] = ["target", "out", "node_modules", ".git"];

/// Finds every page below a folder.
pub fn find_pages(folder: &Path) -> Vec<PathBuf> {
    let is_own = |entry: &DirEntry| !FOREIGN.iter().any(|name| entry.file_name() == *name);
    let entries = WalkDir::new(folder).into_iter().filter_entry(is_own);
    let mut pages: Vec<PathBuf> = entries.map(|entry| entry.unwrap().into_path()).collect();
    pages.retain(|path| path.extension().is_some_and(|end| end == "md"));
    pages.sort();
    pages
}

/// Returns the text outside code blocks.
fn prose(text: &str) -> String {
    let parts = text.split("```").step_by(2);
    let lines = parts
        .flat_map(str::lines)
        .filter(|line| !line.starts_with("    "));
    lines.collect::<Vec<_>>().join("\n")
}

/// Finds the targets of `[words](target)`.
fn find_links(text: &str) -> Vec<String> {
    let rests = text.split("](").skip(1);
    let targets = rests.filter_map(|rest| rest.split_once(')'));
    targets.map(|(target, _)| target.to_owned()).collect()
}

/// Names headings as GitHub does: lower case, no punctuation, hyphens for spaces.
fn anchors(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| -> String {
        let words = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = words
            .chars()
            .filter(|sign| sign.is_alphanumeric() || " -_".contains(*sign));
        kept.map(|sign| if sign == ' ' { '-' } else { sign })
            .collect()
    };
    headings.map(anchor).collect()
}

/// Returns whether a link leads somewhere.
fn leads_somewhere(page: &Path, target: &str) -> bool {
    let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
    let path = match file {
        "" => page.to_owned(),
        file => page.parent().unwrap().join(file),
    };
    let has_anchor = || anchors(&fs::read_to_string(&path).unwrap()).contains(&anchor.to_owned());
    target.contains("://") || path.exists() && (anchor.is_empty() || has_anchor())
}

#[test]
fn every_link_between_pages_has_a_target() {
    let pages = find_pages(&root());
    let mut count = 0;
    for page in &pages {
        for target in find_links(&prose(&fs::read_to_string(page).unwrap())) {
            count += 1;
            assert!(
                leads_somewhere(page, &target),
                "{}: {target}",
                page.display()
            );
        }
    }
    assert!(
        pages.len() > 10 && count > 40,
        "only {count} links were found"
    );
}

#[test]
fn links_lead_from_the_readme_to_every_guide() {
    let mut reached = BTreeSet::new();
    let mut pending = vec![root().join("README.md").canonicalize().unwrap()];
    while let Some(page) = pending.pop() {
        if reached.insert(page.clone()) {
            let links = find_links(&prose(&fs::read_to_string(&page).unwrap()));
            let files = links.iter().map(|link| link.split('#').next().unwrap());
            let pages = files.filter(|file| file.ends_with(".md"));
            let paths = pages.map(|file| page.parent().unwrap().join(file));
            // A link that leads nowhere fails the test above.
            pending.extend(paths.filter_map(|path| path.canonicalize().ok()));
        }
    }
    for guide in ["docs", "results", "crates/engine/guides"]
        .map(|folder| find_pages(&root().join(folder)))
        .concat()
    {
        let is_reached = reached.contains(&guide.canonicalize().unwrap());
        assert!(is_reached, "no links lead to {}", guide.display());
    }
}

#[test]
fn the_page_of_evidence_names_tests_that_exist() {
    let page = fs::read_to_string(root().join("docs/evidence.md")).unwrap();
    let makefile = fs::read_to_string(root().join("Makefile")).unwrap();
    let mut count = 0;
    for row in page.lines().filter(|line| line.ends_with("` |")) {
        let cell = row.rsplit('|').nth(1).unwrap();
        for name in cell.split('`').skip(1).step_by(2) {
            count += 1;
            let is_test = |path: PathBuf| path.is_dir() || path.with_extension("rs").is_file();
            let exists = match name.split_once(' ') {
                Some(("make", target)) => makefile.contains(&format!("\n{target}:")),
                Some((program, module)) => {
                    let module = module.replace("::", "/");
                    is_test(root().join("tests").join(program).join(module))
                }
                None => is_test(root().join(name)),
            };
            assert!(exists, "docs/evidence.md: no test is called {name}");
        }
    }
    assert!(count > 30, "only {count} tests were found");
}

/// Languages of code that the site's highlighter knows; it complains about others. Rust is not among
/// them: the site would ask a server of Rust's about it.
const HIGHLIGHTED: [&str; 7] = ["c", "js", "python", "sh", "text", "toml", "yaml"];

#[test]
fn code_is_in_a_language_that_the_site_highlights() {
    for page in find_pages(&root()) {
        let text = fs::read_to_string(&page).unwrap();
        let fences = text.lines().filter_map(|line| line.strip_prefix("```"));
        for language in fences.filter(|language| !language.is_empty()) {
            let place = page.display();
            assert!(HIGHLIGHTED.contains(&language), "{place}: {language}");
        }
    }
}
