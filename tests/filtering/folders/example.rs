//! Folders that load: the documented example, and the built-in ones.

use filters::{Filter, Limits, Value, try_out};
use tests::filter_folder::shipped_filter;
use tests::near::assert_near;
use tests::picture::{Picture, white};
use tests::shared_gpu;

use super::documented;
use crate::filter_files::ready;

#[test]
fn the_documented_example_loads_from_a_folder_and_blurs() {
    let filter = documented().load().unwrap();
    assert_eq!(filter.alignment, frame::Alignment::Centred);
    assert_eq!(filter.settings(None).unwrap().preset, "fast");
    // A bar that moves right, at the middle of a wide image.
    let bar = |x: u32| (40..50).contains(&x);
    let mut picture = Picture::new(90, 5, |x, _| white(20.0).gray(bar(x).into()));
    picture.exposure = 0.5;
    let mut blur = ready(&filter, (90, 5)).unwrap();
    let outputs = blur.run(&picture.input(&[&picture.color])).unwrap();
    let output = &outputs[0];
    let row: Vec<f32> = (0..90).map(|x| output.at(x, 2)[0]).collect();
    // Ten pixels of motion on ten pixels of bar give a triangle from 35 to 55. Taps of one weight
    // move light, and add none.
    let energy: f32 = row.iter().sum();
    assert_near(energy, 10.0, 1e-4);
    let moments = row.iter().enumerate().map(|(x, v)| (x as f32 + 0.5) * v);
    // A centred blur stays where it was.
    assert_near(moments.sum::<f32>() / energy, 45.0, 1e-3);
    let reach: Vec<usize> = (0..90).filter(|x| row[*x] > 0.0).collect();
    assert_eq!((reach[0], reach[reach.len() - 1]), (35, 54));
}

#[test]
fn the_smallest_reach_that_covers_a_trail_is_set() {
    let flood = Filter::builtin("jump_flood").unwrap();
    // Largest steps of 8, 16 and 128 pixels; then of 1, 16 and 128.
    for (preset, pixels, expected) in [
        ("paper", 1, 1),
        ("paper", 8, 1),
        ("paper", 9, 2),
        ("paper", 128, 5),
        ("corrected", 1, 1),
        ("corrected", 16, 5),
        ("corrected", 128, 8),
    ] {
        let settings = flood.settings(Some(preset)).unwrap();
        let reaching = settings.with_reach(&flood, pixels).unwrap();
        let expected = Value::Integer(expected);
        assert_eq!(reaching.values["passes"], expected, "{preset}, {pixels}");
    }
    let error = flood.settings(None).unwrap().with_reach(&flood, 1 << 20);
    let says = "jump_flood.passes: found 18; allowed: a whole number from 1 to 12";
    assert_eq!(error.unwrap_err().to_string(), says);
    let gather = Filter::builtin("velocity_gather").unwrap();
    let settings = gather.settings(None).unwrap();
    assert_eq!(settings.with_reach(&gather, 256).unwrap(), settings);
}

#[test]
fn built_in_filters_load_from_disk_unchanged() {
    let shaders = shipped_filter("");
    let folders = std::fs::read_dir(&shaders).unwrap().map(Result::unwrap);
    let mut names: Vec<String> = folders
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert!(names.len() > 1);
    assert_eq!(Filter::builtin_names(), names);
    for name in Filter::builtin_names() {
        let built_in = Filter::builtin(&name).unwrap();
        let on_disk = Filter::load(&shaders.join(&name)).unwrap();
        assert_eq!(built_in.name, name);
        assert_eq!(built_in.parameters, on_disk.parameters);
        assert_eq!(built_in.presets, on_disk.presets);
        let says = [
            built_in.summary,
            built_in.source,
            built_in.reach,
            built_in.cannot,
        ];
        let says_all = says.iter().all(|text| !text.is_empty());
        assert!(says_all, "{name} says what it is and what it cannot do");
    }
}

fn try_out_builtin(name: &str) {
    let filter = Filter::builtin(name).unwrap();
    try_out(shared_gpu(), &filter).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn built_in_filters_work_at_the_ends_of_their_ranges_and_on_the_least_adapter() {
    for name in Filter::builtin_names() {
        let filter = Filter::builtin(&name).unwrap();
        let checked = Limits::lowest().check(&filter);
        checked.unwrap_or_else(|error| panic!("{error}"));
    }
    // Filters with the most parameters, tiles of any size, and taps at whole pixels.
    for name in ["jump_flood", "guertin", "kino"] {
        try_out_builtin(name);
    }
}

#[test]
#[ignore = "prove: every built-in filter at the ends of its ranges"]
fn every_built_in_filter_works_at_the_ends_of_its_ranges() {
    for name in Filter::builtin_names() {
        try_out_builtin(&name);
    }
}
