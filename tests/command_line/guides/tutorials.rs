//! The rankings that the pages of engines show, against what their commands print.

use std::fs;

use tests::root;

use super::page::{Step, find_steps};
use super::reader::Reader;
use crate::sandbox::{assert_done, stdout};

/// A command of a page, and the lines that the page shows below it.
struct Shown {
    page: String,
    command: String,
    lines: Vec<String>,
}

/// Finds the rankings in a page: blocks that begin with a mean, each with the last command before it.
fn find_rankings(name: &str, page: &str) -> Vec<Shown> {
    let mut shown = Vec::new();
    let mut before = String::new();
    for block in page.split("\n\n") {
        if block.starts_with("    mean over") {
            let runs = find_steps(&before).into_iter().rev();
            let command = runs.into_iter().find_map(|step| match step {
                Step::Run(command) if command.starts_with("shuttertruth run") => Some(command),
                _ => None,
            });
            let lines = block.lines().map(|line| line[4..].to_owned());
            shown.push(Shown {
                page: name.to_owned(),
                command: command.expect("a command above the ranking"),
                lines: lines.filter(|line| line != "..").collect(),
            });
        }
        before += block;
        before += "\n\n";
    }
    shown
}

#[test]
#[ignore = "prove: the rankings of the pages of engines, as `run` prints them"]
fn the_rankings_of_engines_are_what_run_prints() {
    let mut shown = Vec::new();
    for page in fs::read_dir(root().join("docs/engines")).unwrap() {
        let page = page.unwrap();
        let name = page.file_name().into_string().unwrap();
        shown.extend(find_rankings(
            &name,
            &fs::read_to_string(page.path()).unwrap(),
        ));
    }
    assert!(shown.len() >= 4, "only {} rankings were found", shown.len());
    let reader = Reader::new();
    for Shown {
        page,
        command,
        lines,
    } in shown
    {
        let output = reader.run(&command);
        assert_done(&output);
        let printed = stdout(&output);
        if !printed.contains("llvmpipe") {
            eprintln!("not compared: the pages have the scores of Mesa's llvmpipe");
            return;
        }
        for line in lines {
            let found = printed.lines().any(|other| other.starts_with(&line));
            assert!(
                found,
                "{page}: `run` does not print \"{line}\"; it prints:\n{printed}"
            );
        }
    }
}
