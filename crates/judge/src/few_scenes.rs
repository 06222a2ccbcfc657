//! Runs with few scenes, whose means say little.

use measure::MIN_SCENES;

/// Says that means are over few scenes; none for one scene, which has no mean, or for enough.
pub fn few_scenes_text(scenes: usize) -> Option<String> {
    (2..MIN_SCENES).contains(&scenes).then(|| {
        format!(
            "Few scenes: a mean over {scenes} is uncertain. {MIN_SCENES} or more tell close filters apart better."
        )
    })
}

#[test]
fn few_scenes_are_two_to_four() {
    let is_few = [0, 1, 2, 4, 5, 26].map(|scenes| few_scenes_text(scenes).is_some());
    assert_eq!(is_few, [false, false, true, true, false, false]);
}
