//! `catalogue`: the scenes in pictures.

use std::fs;

use crate::bench::{Bench, assert_done, quick, stdout};

#[test]
fn the_catalogue_shows_every_scene_and_all_its_pictures_are_there() {
    let bench = Bench::new();
    let output = bench.shuttertruth(&quick("catalogue", "16"));
    assert_done(&output);
    assert!(stdout(&output).contains("catalogue.md"));
    let page = fs::read_to_string(bench.path("out/catalogue.md")).unwrap();
    assert!(
        page.contains("## plate\n\nnothing: it serves the tests of the command line"),
        "{page}"
    );
    assert!(page.contains("jump_flood:paper, FLIP 0."), "{page}");
    // A page is no run: what is there of one stays.
    assert!(!bench.path("out/run.json").exists());
    let pictures: Vec<&str> = (page.split("](").skip(1))
        .map(|rest| rest.split_once(')').unwrap().0)
        .collect();
    assert_eq!(pictures.len(), 5, "{pictures:?}");
    for picture in pictures {
        let bytes = fs::read(bench.path("out").join(picture)).unwrap();
        assert!(bytes.starts_with(b"\x89PNG"), "{picture}");
    }
}
