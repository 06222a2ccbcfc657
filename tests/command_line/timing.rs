//! `shuttertruth bench`.

use tests::text::{assert_contains, squeeze};

use crate::sandbox::Sandbox;

#[test]
fn a_bench_prints_and_writes_the_same_times() {
    let sandbox = Sandbox::new();
    let filters = "jump_flood_packed:paper,identity";
    let words = "bench --quiet --as-written --size 32x16 --filters";
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
}
