//! Things that turn.

use super::assert_worse;
use super::rendered_scene::RenderedScene;

#[test]
fn a_rolling_wheel_smears_its_still_cover() {
    let scenes = ["wheel_roll", "wheel_roll@locked"].map(RenderedScene::new);
    let cover = |filter: &str| {
        scenes
            .each_ref()
            .map(|scene| scene.object_label_tv(filter, "cover"))
    };
    // Measured 27: slow parts smear as far as the fastest part near them.
    assert_worse("cover in jimenez:wicked", cover("jimenez:wicked"), 10.0);
    // Spokes that turn on circles lie outside every straight smear. Measured 4.2 and 3.7.
    for filter in ["mcguire:paper", "guertin:paper"] {
        let all = scenes
            .each_ref()
            .map(|scene| scene.score(filter, "label_tv"));
        assert_worse(&format!("label_tv of {filter}"), all, 2.5);
    }
}
