//! The gallery of a finished run.

use std::fs;

use frame::read_png;
use tests::text::assert_contains;

use crate::sandbox::Sandbox;

#[test]
fn a_gallery_shows_each_scene_with_its_best_and_its_worst_filter() {
    let sandbox = Sandbox::two_scenes();
    sandbox.measure("--filters identity,velocity_gather:fine,bevy:default");
    sandbox.done("report out --gallery shown");
    let page = fs::read_to_string(sandbox.path("shown/README.md")).unwrap();
    let parts = ["](truths.png)", "## plate", "](slow.png)", "64x32 pixels"];
    assert_contains(&page, &parts);
    assert_contains(&page, &["| best | `", "| worst | `"]);
    assert!(!page.contains("`identity:default`"), "{page}");
    let strip = read_png(&sandbox.path("shown/plate.png")).unwrap();
    // Five pictures of 64x32 with gaps of 2 pixels.
    assert_eq!((strip.width, strip.height), (5 * 66 - 2, 32));
    let sheet = read_png(&sandbox.path("shown/truths.png")).unwrap();
    assert_eq!((sheet.width, sheet.height), (2 * 66 - 2, 32));
    assert_eq!(sheet.at(10, 10), strip.at(66 + 10, 10), "the first truth");
}

#[test]
fn a_run_of_only_references_makes_no_gallery() {
    let found = ["no best and no worst", "run filters"];
    Sandbox::measured().refuse("report out --gallery shown", &found);
}
