//! Runs with few scenes, whose means say little.

/// Fewest scenes for which the interval of a mean is of use: with two, the 95 % CI is 7 times as
/// wide as with five of the same scatter.
const ENOUGH_SCENES: usize = 5;

/// Says that means are over few scenes; none for one scene, which has no mean, or for enough.
pub fn few_scenes_text(scenes: usize) -> Option<String> {
    (2..ENOUGH_SCENES).contains(&scenes).then(|| {
        format!(
            "Few scenes: a mean over {scenes} is uncertain. Add scenes, five at least, to tell close filters apart."
        )
    })
}

#[test]
fn few_scenes_are_two_to_four() {
    let is_few = [0, 1, 2, 4, 5, 26].map(|scenes| few_scenes_text(scenes).is_some());
    assert_eq!(is_few, [false, false, true, true, false, false]);
}
