//! Things that turn.

use super::assert_worse;
use super::rendered_scene::RenderedScene;

#[test]
fn a_rolling_wheel_smears_the_cover_that_does_not_turn_with_it() {
    let scenes = ["wheel_roll", "wheel_roll@locked"].map(RenderedScene::new);
    let cover = |filter: &str| {
        scenes
            .each_ref()
            .map(|scene| scene.object_label_tv(filter, "cover"))
    };
    // Measured 27: what is slow smears as far as the fastest near it.
    assert_worse("cover in jimenez:wicked", cover("jimenez:wicked"), 10.0);
    // Spokes that turn on circles leave every straight smear behind. Measured 4.2 and 3.7.
    for filter in ["mcguire:paper", "guertin:paper"] {
        let all = scenes
            .each_ref()
            .map(|scene| scene.score(filter, "label_tv"));
        assert_worse(&format!("label_tv of {filter}"), all, 2.5);
    }
}
