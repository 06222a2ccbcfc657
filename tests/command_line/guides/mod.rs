//! Every command of every page, run in the page's order. `make guides` runs these tests.

mod page;
mod quick;
mod reader;
mod tables;

use std::fs;
use std::sync::LazyLock;
use std::time::Instant;

use page::{Step, find_steps};
use quick::shorten;
use reader::Reader;
use serde::Deserialize;
use tests::root;

use crate::links::find_pages;
use crate::sandbox::{stderr, stdout};

/// Commands that are not run, each below the reason.
const NOT_RUN: &str = include_str!("not_run.txt");

/// Prerequisites of a page's command.
#[derive(Clone, Deserialize)]
struct Prepared {
    page: String,
    /// The beginning of the command.
    command: String,
    /// The line of shell that makes what the command needs.
    shell: String,
}

static PREPARED: LazyLock<Vec<Prepared>> = LazyLock::new(|| {
    let mut table: toml::Table = include_str!("prepared.toml").parse().unwrap();
    let rows = table.remove("prepared").unwrap();
    rows.try_into().unwrap()
});

fn list_not_run() -> impl Iterator<Item = &'static str> {
    let lines = NOT_RUN.lines();
    lines.filter(|line| !line.is_empty() && !line.starts_with('#'))
}

/// Lists the pages, by their paths in the repository, with their readers' steps.
fn read_pages() -> Vec<(String, Vec<Step>)> {
    let pages = find_pages(&root()).into_iter().map(|path| {
        let name = path.strip_prefix(root()).unwrap().display().to_string();
        (name, find_steps(&fs::read_to_string(path).unwrap()))
    });
    pages.filter(|(_, steps)| !steps.is_empty()).collect()
}

/// Finds the line of shell that makes a command's prerequisites.
fn find_prepared(page: &str, command: &str) -> Option<&'static str> {
    let is_needed =
        |prepared: &&Prepared| prepared.page == page && command.starts_with(&prepared.command);
    let prepared = PREPARED.iter().find(is_needed);
    prepared.map(|prepared| prepared.shell.as_str())
}

fn is_left_out(command: &str) -> bool {
    list_not_run().any(|left_out| left_out == command)
}

#[test]
fn every_exception_is_a_command_of_a_page() {
    let pages = read_pages();
    let commands: Vec<(&str, &str)> = (pages.iter())
        .flat_map(|(page, steps)| steps.iter().map(move |step| (page.as_str(), step)))
        .filter_map(|(page, step)| match step {
            Step::Run(command) => Some((page, command.as_str())),
            Step::Write { .. } => None,
        })
        .collect();
    assert!(commands.len() > 60, "only {} were found", commands.len());
    for left_out in list_not_run() {
        let shown = commands.iter().any(|(_, command)| *command == left_out);
        assert!(shown, "no page shows the exception \"{left_out}\"");
    }
    for (beginning, _) in quick::REPLACED {
        let shown = (commands.iter()).any(|(_, command)| command.starts_with(beginning));
        assert!(shown, "no page shows a command \"{beginning} ..\"");
    }
    for Prepared {
        page,
        command: beginning,
        ..
    } in PREPARED.iter()
    {
        let shown =
            (commands.iter()).any(|(of, command)| of == page && command.starts_with(beginning));
        assert!(shown, "{page} has no command \"{beginning} ..\"");
    }
}

/// Runs a command; returns a description of its failure.
fn find_failure(reader: &Reader, page: &str, command: &str) -> Option<String> {
    let start = Instant::now();
    let output = reader.run(command);
    let seconds = start.elapsed().as_secs_f64();
    eprintln!("{seconds:6.1} s  {page}: {command}");
    let said = stdout(&output) + &stderr(&output);
    let ended = format!("{page}: {command}\nends with {}:\n{said}", output.status);
    (!output.status.success()).then_some(ended)
}

#[test]
#[ignore = "prove: every command of every page"]
fn every_command_of_the_pages_ends_with_exit_code_0() {
    let mut failed = Vec::new();
    let names = std::env::var("PAGES").unwrap_or_default();
    let mut pages = read_pages();
    if !names.is_empty() {
        let names: Vec<&str> = names.split(',').collect();
        pages.retain(|(page, _)| names.contains(&page.as_str()));
        assert_eq!(
            pages.len(),
            names.len(),
            "PAGES={names:?} are no pages with commands"
        );
    }
    for (page, steps) in pages {
        let reader = Reader::new();
        for step in steps {
            match step {
                Step::Write { path, text } => reader.write(&path, &text),
                Step::Run(command) if is_left_out(&command) => {}
                Step::Run(command) => {
                    if let Some(line) = find_prepared(&page, &command) {
                        failed.extend(find_failure(&reader, &page, line));
                    }
                    failed.extend(find_failure(&reader, &page, &shorten(&command)));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
