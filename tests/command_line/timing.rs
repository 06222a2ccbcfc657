//! `shuttertruth bench`.

use tests::filter_folder::write_manifest;
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_refused, split};

#[test]
fn a_bench_prints_and_writes_the_same_times() {
    let sandbox = Sandbox::new();
    let table = sandbox.execute(&split(
        "bench --quiet --as-written --size 32x16 --filters jump_flood_packed:paper,identity",
    ));
    assert_contains(
        &table,
        &[
            "32x16",
            "quartiles",
            // The baseline takes part without being named.
            "jump_flood:paper",
            "jump_flood_packed:paper",
            "  dilate x 3",
            "identity:default",
            "copy of a buffer",
            "256 / 16",
            "written: out/bench.json",
        ],
    );

    // Lines of 80 columns may break anywhere.
    let words: Vec<&str> = table.split_whitespace().collect();
    assert!(words.join(" ").contains("of 20 rounds by"), "{table}");

    let done: suite::Bench = sandbox.read_json("out/bench.json");
    assert_eq!((done.width, done.height, done.rounds), (32, 16, 20));
    let names: Vec<&str> = done.cases.iter().map(|case| &case.filter[..]).collect();
    assert_eq!(names, ["jump_flood", "jump_flood_packed", "identity"]);
    let baseline = &done.cases[0];
    assert_eq!(
        (baseline.ratio.lower_quartile, baseline.ratio.upper_quartile),
        (1.0, 1.0)
    );
    for case in &done.cases {
        let spread = case.seconds;
        assert!(
            0.0 < spread.lower_quartile
                && spread.lower_quartile <= spread.median
                && spread.median <= spread.upper_quartile
        );
        let passes: f64 = case.passes.iter().map(|pass| pass.bytes_per_pixel).sum();
        assert_eq!(case.bytes_per_pixel, passes);
        let part = case.bytes_per_second / done.copy.bytes_per_second;
        assert_eq!(case.part_of_copy, part);
    }
    assert_eq!(done.cases[2].bytes_per_pixel, 32.0);
    let passes: Vec<_> = (done.reaches[0].points.iter())
        .map(|point| (point.pixels, point.value.clone().unwrap().to_string()))
        .collect();
    let expected = [
        (8, "1"),
        (16, "2"),
        (32, "3"),
        (64, "4"),
        (128, "5"),
        (256, "6"),
    ];
    assert_eq!(
        passes,
        expected.map(|(pixels, value)| (pixels, value.to_owned()))
    );
    assert_eq!(done.reaches[2].parameter, None);
    assert!(done.reaches.iter().all(|cost| cost.growth.is_some()));
}

#[test]
fn bad_arguments_of_bench_are_refused() {
    let sandbox = Sandbox::new();
    let program = "command = ['cp', '{frame}', '{out}']";
    write_manifest(&sandbox.path("outside"), "outside", program);
    let rows: &[(&[&str], &[&str])] = &[
        (&["--filters", "./outside"], &["outside is a program"]),
        (&["--filters", "jumpflood"], &["jumpflood", "jump_flood"]),
        (&["--filters", "identity:fast"], &["fast", "default"]),
        (&["--filters", "no/such/folder"], &["no/such/folder"]),
        (&["--size", "0x0"], &["0x0", "WIDTHxHEIGHT"]),
        (&["--size", "640"], &["WIDTHxHEIGHT"]),
        (&["--rounds", "19"], &["19 is not in 20..=10000"]),
        (&["--rounds", "many"], &["'many' for '--rounds <N>'"]),
        (&["--adapter", "no such card"], &["no such card", "found:"]),
        (&["--speed", "3"], &["--speed"]),
    ];
    for (more, parts) in rows {
        let words = [&["bench", "--quiet"], *more].concat();
        assert_refused(&sandbox.shuttertruth(&words), 2, parts);
        assert!(
            !sandbox.path("out").exists(),
            "{more:?} left something behind"
        );
    }
    assert_refused(
        &sandbox.without_adapter(&["bench"]),
        3,
        &["mesa-vulkan-drivers"],
    );
}
