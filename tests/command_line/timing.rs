//! `shuttertruth bench`.

use tests::filter_folder::write_manifest;
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_refused};

#[test]
fn a_bench_prints_and_writes_the_same_times() {
    let sandbox = Sandbox::new();
    let filters = "jump_flood_packed:paper,identity";
    let words = "bench --quiet --as-written --size 32x16 --filters";
    let table = sandbox.done(&format!("{words} {filters}"));
    let parts = [
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
    ];
    assert_contains(&table, &parts);

    // Lines of 80 columns may break anywhere.
    let words: Vec<&str> = table.split_whitespace().collect();
    assert!(words.join(" ").contains("of 20 rounds by"), "{table}");

    let done: suite::Bench = sandbox.read_json("out/bench.json");
    assert_eq!((done.width, done.height, done.rounds), (32, 16, 20));
    let names: Vec<&str> = done.cases.iter().map(|case| &case.filter[..]).collect();
    assert_eq!(names, ["jump_flood", "jump_flood_packed", "identity"]);
    let ratio = &done.cases[0].ratio;
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
        let passes: f64 = case.passes.iter().map(|pass| pass.bytes_per_pixel).sum();
        assert_eq!(case.bytes_per_pixel, passes);
        let part = case.bytes_per_second / done.copy.bytes_per_second;
        assert_eq!(case.part_of_copy, part);
    }
    assert_eq!(done.cases[2].bytes_per_pixel, 32.0);
    let points = done.reaches[0].points.iter();
    let passes: Vec<String> = points
        .map(|point| format!("{}: {}", point.pixels, point.value.clone().unwrap()))
        .collect();
    assert_eq!(
        passes.join(", "),
        "8: 1, 16: 2, 32: 3, 64: 4, 128: 5, 256: 6"
    );
    assert_eq!(done.reaches[2].parameter, None);
    assert!(done.reaches.iter().all(|cost| cost.growth.is_some()));
}

#[test]
fn bad_arguments_of_bench_are_refused() {
    let sandbox = Sandbox::new();
    let program = "command = ['cp', '{frame}', '{out}']";
    write_manifest(&sandbox.path("outside"), "outside", program);
    sandbox.refuse_rows(
        "bench --quiet",
        "--filters ./outside | outside is a program
        --filters jumpflood | jumpflood | jump_flood
        --filters identity:fast | fast | default
        --filters no/such/folder | no/such/folder
        --size 0x0 | 0x0 | WIDTHxHEIGHT
        --size 640 | WIDTHxHEIGHT
        --rounds 19 | 19 is not in 20..=10000
        --rounds many | 'many' for '--rounds <N>'
        --adapter none_such | none_such | found:
        --speed 3 | --speed",
    );
    assert!(!sandbox.path("out").exists(), "nothing is written");
    let output = sandbox.without_adapter(&["bench"]);
    assert_refused(&output, 3, &["mesa-vulkan-drivers"]);
}
