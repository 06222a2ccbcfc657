//! Costs on the page: the bench beside the run.

use std::fs;

use tests::text::assert_contains;

use super::{WORDS, find_between, make_page};
use crate::bench::{Bench, assert_done, assert_refused, split};

#[test]
fn costs_are_those_of_the_bench_beside_the_run() {
    let bench = Bench::new();
    let words = "--filters identity,mcguire:paper --set mcguire.samples=7";
    assert_done(&bench.run(&split(words)));
    let without = make_page(&bench);
    assert!(without.contains("Nothing was timed beside this run."));
    let words =
        "bench --quiet --filters identity,jump_flood:paper,mcguire:paper --size 64x32 --out out";
    bench.done(&split(words));
    let page = make_page(&bench);
    let text = fs::read_to_string(bench.path("out/bench.json")).unwrap();
    let timed: suite::Bench = serde_json::from_str(&text).unwrap();
    let seconds = timed
        .cases
        .iter()
        .find(|cost| cost.filter == "identity")
        .unwrap()
        .seconds;
    // In every table of scores one cell of the filter that was run and timed, and none of those that were only timed, or run with
    // other parameters.
    let cell = format!("<td class=\"cost\" data-value=\"{}\">", seconds.median);
    assert_eq!(page.matches(&cell).count(), 9);
    assert_eq!(page.matches("<td class=\"cost\" data-value").count(), 9);
    let costs = find_between(&page, "<section class=\"costs\">", "</section>")[0];
    assert_contains(
        &costs,
        &[
            "identity:default",
            "copy",
            "256 px",
            "accumulate:64 (trailing)",
            timed.adapter.name.as_str(),
        ],
    );
    fs::write(
        bench.path("out/bench.json"),
        text.replace("\"format\": 1", "\"format\": 0"),
    )
    .unwrap();
    let parts = [
        "out/bench.json: has format 0; allowed: 1",
        "`shuttertruth bench`",
    ];
    assert_refused(&bench.shuttertruth(&WORDS), 2, &parts);
}
