//! `bench`: its times, and their section on the page of a run. A part of tests/command_line, which
//! is linked with the program once.

use tests::filter_folder::one_kernel;
use tests::text::{assert_contains, squeeze};

use crate::exported_tables::read_csv;
use crate::report::{REPORT, between, make_page};
use crate::sandbox::Sandbox;

#[test]
fn a_bench_prints_and_writes_the_same_times() {
    let sandbox = Sandbox::new();
    let filters = "jump_flood_packed:paper,identity";
    let words = "bench --quiet --as-written --size 32x16 --csv times.csv --filters";
    let table = sandbox.done(&format!("{words} {filters}"));
    let parts = [
        "32x16",
        "quartiles",
        // The baseline is included without being named.
        "jump_flood:paper",
        "jump_flood_packed:paper",
        "  dilate x 3",
        "identity:default",
        "copy of a buffer",
        "256 / 16",
        "written: out/bench.json",
    ];
    assert_contains(&table, &parts);

    assert_contains(&squeeze(&table), &["of 20 rounds by"]);

    let done: bench::Bench = sandbox.read_json("out/bench.json");
    assert_eq!((done.width, done.height, done.rounds), (32, 16, 20));
    let names: Vec<&str> = done.cases.iter().map(|case| &case.filter[..]).collect();
    assert_eq!(names, ["jump_flood", "jump_flood_packed", "identity"]);
    let ratio = done.cases[0].ratio.unwrap();
    assert_eq!([ratio.lower_quartile, ratio.upper_quartile], [1.0, 1.0]);
    for case in &done.cases {
        let spread = case.seconds;
        let quartiles = [
            0.0,
            spread.lower_quartile,
            spread.median,
            spread.upper_quartile,
        ];
        assert!(quartiles.is_sorted() && spread.lower_quartile > 0.0);
        let passes: Option<f64> = case.passes.iter().map(|pass| pass.bytes_per_pixel).sum();
        assert_eq!(case.bytes_per_pixel, passes);
        let speed = done.copy.as_ref().unwrap().bytes_per_second;
        let part = case.bytes_per_second.map(|rate| rate / speed);
        assert_eq!(case.part_of_copy, part);
    }
    assert_eq!(done.cases[2].bytes_per_pixel, Some(32.0));
    let points = done.reaches[0].points.iter();
    let passes: Vec<String> = points
        .map(|point| format!("{}: {}", point.pixels, point.value.clone().unwrap()))
        .collect();
    let due = "8: 1, 16: 2, 32: 3, 64: 4, 128: 5, 256: 6";
    assert_eq!(passes.join(", "), due);
    assert_eq!(done.reaches[2].parameter, None);
    assert!(done.reaches.iter().all(|cost| cost.growth.is_some()));
    assert_csv(&sandbox.text("times.csv"), &done);
}

/// Checks that the CSV has a row for each case and each of its passes.
fn assert_csv(text: &str, done: &bench::Bench) {
    let rows = read_csv(text);
    for case in &done.cases {
        let name = format!("{}:{}", case.filter, case.preset);
        let of_case = rows.iter().filter(|row| row["filter"] == name);
        let passes = of_case.clone().filter(|row| !row["pass"].is_empty());
        assert_eq!(passes.count(), case.passes.len(), "{text}");
        assert_eq!(of_case.count(), case.passes.len() + 1, "{text}");
    }
    let passes = rows.iter().filter(|row| !row["pass"].is_empty()).count();
    assert_eq!(rows.len(), passes + done.cases.len(), "{text}");
    assert!(passes >= 2, "{text}");
    for row in rows {
        assert!(row["milliseconds"].parse::<f64>().unwrap() > 0.0, "{text}");
    }
}

/// Writes a filter whose preset has a radius of 16 pixels, for pictures 256 pixels wide.
fn write_box_blur(sandbox: &Sandbox) {
    let manifest = include_str!("../../../../tests/fixtures/filters/box_blur.toml");
    let body = include_str!("../../../../tests/fixtures/filters/box_blur.wgsl");
    sandbox.write_filter("mine", manifest, &one_kernel("radius: i32", body));
}

/// Checks that a preset is scaled to the picture's width unless lengths stay as written.
fn assert_scaled(sandbox: &Sandbox) {
    let done: serde_json::Value = sandbox.read_json("out/bench.json");
    let mut cases = done["cases"].as_array().unwrap().iter();
    let case = cases.find(|case| case["filter"] == "mine").unwrap();
    assert_eq!(case["parameters"]["radius"], 4);
    assert_eq!(case["reference_width"], 256);
}

#[test]
fn costs_come_from_the_bench_beside_the_run() {
    let sandbox = Sandbox::new();
    let words = "--filters identity,mcguire:paper --set mcguire.samples=7";
    let overridden = "mcguire:paper samples=7";
    for more in ["", "--table"] {
        assert_contains(&sandbox.measure(&format!("{words} {more}")), &[overridden]);
    }
    let parts = ["This run has no bench.json.", overridden];
    assert_contains(&make_page(&sandbox), &parts);
    let output = "out/plate/mcguire_paper_samples_7/output.exr";
    assert!(sandbox.path(output).is_file());
    write_box_blur(&sandbox);
    let filters = "identity,jump_flood:paper,mcguire:paper,./mine";
    let bench = "bench --quiet --size 64x32 --out out --markdown - --filters";
    let printed = sandbox.done(&format!("{bench} {filters}"));
    assert!(printed.starts_with("| filter / pass | ms |"), "{printed}");
    assert_scaled(&sandbox);
    let page = make_page(&sandbox);
    let mut timed: bench::Bench = sandbox.read_json("out/bench.json");
    let mut costs = timed.cases.iter();
    let timing = costs.find(|cost| cost.filter == "identity").unwrap();
    // Every table of scores has one cell for the filter both run and timed. Filters that were only
    // timed, or run with other parameters, have none.
    let cell = "<td class=\"cost\" data-value";
    let timed_cell = format!("{cell}=\"{}\">", timing.seconds.median);
    for cell in [cell, &timed_cell] {
        assert_eq!(page.matches(cell).count(), 11, "{cell}");
    }
    let costs = between(&page, "<section class=\"costs\">", "</section>")[0];
    let adapter = timed.adapter.name.as_str();
    let references = [
        "identity:default",
        "copy",
        "256 px",
        "accumulate:64 (trailing)",
    ];
    assert_contains(costs, &references);
    assert_contains(costs, &[adapter]);
    sandbox.edit("out/bench.json", "\"format\": 1", "\"format\": 0");
    let parts = [
        "out/bench.json: has format 0; allowed: 1",
        "`shuttertruth bench`",
    ];
    sandbox.refuse(REPORT, &parts);
    timed.cases[0].seconds.lower_quartile = 0.0;
    sandbox.put("out/bench.json", serde_json::to_vec(&timed).unwrap());
    sandbox.refuse(REPORT, &["holds a time of 0 s; allowed: 0.000000001 to"]);
}
