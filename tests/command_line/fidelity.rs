//! Presets against transcriptions of their original programs.

use std::collections::BTreeMap;
use std::process::{Command, Output};

use tests::root;
use tests::text::assert_contains;

use crate::sandbox::{python_with, stderr, stdout};

/// Runs examples/fidelity/compare.py.
fn compare(more: &[&str]) -> Output {
    let out = tempfile::tempdir().unwrap();
    let mut command = Command::new(python_with(&["numpy", "OpenEXR"]));
    let script = root().join("examples/fidelity/compare.py");
    command.arg("-B").arg(script);
    command.args(["--program", env!("CARGO_BIN_EXE_shuttertruth")]);
    command.arg("--scenes-dir").arg(tests::scenes());
    command.arg("--out").arg(out.path()).args(more);
    command.output().unwrap()
}

/// Splits the rows of all tables into cells.
fn rows(page: &str) -> impl Iterator<Item = Vec<&str>> {
    let rows = page.lines().filter(|line| line.starts_with("| `"));
    rows.map(|row| row.trim_matches('|').split('|').map(str::trim).collect())
}

/// Lists presets, each with its original or the reason for having none. A row of the page may have
/// several presets.
fn originals(page: &str) -> BTreeMap<&str, &str> {
    let pairs = rows(page).flat_map(|cells| {
        let presets = cells[0].split(", ");
        let pairs: Vec<_> = presets.map(|preset| (preset, cells[1])).collect();
        pairs
    });
    pairs.collect()
}

/// Compares all presets on some scenes; the rows must match the page.
fn assert_page(scenes: &str) {
    let output = compare(&["--scenes", scenes]);
    let printed = stdout(&output);
    assert!(output.status.success(), "{printed}{}", stderr(&output));
    let page = std::fs::read_to_string(root().join("docs/fidelity.md")).unwrap();
    let kept = originals(page.split("\n## The shaders").next().unwrap());
    assert!(
        kept == originals(&printed),
        "docs/fidelity.md has other presets or originals than these:\n{printed}"
    );
    assert!(kept.len() > 20, "{} presets", kept.len());
}

#[test]
#[ignore = "prove: originals beside all presets"]
fn presets_match_their_originals_as_far_as_the_page_says() {
    assert_page("railing");
}

#[test]
#[ignore = "prove: all scenes of the page"]
fn presets_match_their_originals_on_all_scenes_of_the_page() {
    assert_page("fan,railing,two_spheres");
}

/// Changes one value of each preset, and compares these on one scene.
#[track_caller]
fn assert_broken(scene: &str, changes: &[(&str, &str)]) {
    let mut words = vec!["--scenes".to_owned(), scene.to_owned()];
    for (preset, change) in changes {
        let set = format!("{preset}.{change}");
        words.extend(["--only".into(), (*preset).into(), "--set".into(), set]);
    }
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let output = compare(&words);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let printed = stdout(&output);
    let actual = rows(&printed).map(|row| format!("{} {}", row[0], row[row.len() - 1]));
    let due = changes
        .iter()
        .map(|(preset, _)| format!("`{preset}` BROKEN"));
    assert!(actual.eq(due), "{printed}");
    let presets: Vec<&str> = changes.iter().map(|(preset, _)| *preset).collect();
    assert_contains(&stderr(&output), &presets);
}

/// Presets, each with one changed value.
const CHANGES: [(&str, &str); 3] = [
    ("bevy:default", "metric=pixel"),
    ("centred_gather:armory", "taps=middles"),
    ("jump_flood:july_2024", "map=float32"),
];

#[test]
fn a_changed_filter_does_not_match_its_original() {
    assert_broken("railing", &CHANGES);
}

/// Presets that `make prove` changes on the same scene.
const OTHER_CHANGES: [(&str, &str); 5] = [
    ("jimenez:o3de", "tile_lookup=nearest"),
    ("three:default", "divisor=fetches"),
    ("centred_gather:spartan_2024", "smoothing=none"),
    ("babylon:default", "storage=exact"),
    ("kino:default", "least_motion=1"),
];

/// Further presets, each with one changed value.
const MORE_CHANGES: [(&str, &str); 13] = [
    ("jimenez:hdrp", "extent=0.5"),
    ("jimenez:hdrp_mirrored", "mirror=slow_background"),
    ("jimenez:kajiya", "noise=shift"),
    ("jimenez:wicked", "border=clamp"),
    ("realism_effects:default", "jitter=0.5"),
    ("dagor:default", "vignette=0.5"),
    ("godot:addon", "tile_motion=exact"),
    ("godot:engine", "arrival=half"),
    ("vort:default", "depth_scale=50"),
    ("bevy:msaa", "fetch=filtered"),
    ("three:default", "coordinates=texture"),
    ("mcguire:g3d", "neighbor_rule=all"),
    ("jump_flood:july_2024", "way_back=first_match"),
];

#[test]
#[ignore = "prove: more changes of filters"]
fn no_change_of_a_filter_matches_its_original() {
    assert_broken("railing", &OTHER_CHANGES);
    assert_broken("fan", &MORE_CHANGES);
}
