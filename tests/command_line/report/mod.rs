//! The page of a finished run, and the pages and layers beside it.

mod bounds;
mod costs;
mod layers;
mod refusals;
mod scores;
mod tuning;

use std::fs;

use crate::bench::{Bench, assert_done, stdout};

const WORDS: [&str; 4] = ["report", "out/run.json", "--html", "page/report.html"];

/// Makes the page of the bench's last run.
fn make_page(bench: &Bench) -> String {
    let output = bench.shuttertruth(&WORDS);
    assert_done(&output);
    assert!(stdout(&output).contains("written: page/report.html ("));
    fs::read_to_string(bench.path("page/report.html")).unwrap()
}

/// Returns every text between `before` and `after`.
fn find_between<'a>(page: &'a str, before: &str, after: &str) -> Vec<&'a str> {
    let rests = page.split(before).skip(1);
    rests
        .map(|rest| rest.split_once(after).expect("an end").0)
        .collect()
}

/// The part of a page that shows a case, by the case's number.
fn find_article(page: &str, case: usize) -> &str {
    find_between(
        page,
        &format!("<article class=\"case\" id=\"case-{case}\""),
        "</article>",
    )[0]
}
