//! Things in front of and behind one another.

use frame::Alignment;

use super::assert_worse;
use super::rendered_scene::{RenderedScene, value};

#[test]
fn a_train_behind_a_fence_bleeds_onto_the_bars_with_a_wrong_depth_comparison() {
    let [passing, creeping] = ["fence", "fence@creeping"].map(RenderedScene::new);
    let fence =
        |filter: &str| [&passing, &creeping].map(|scene| scene.object_label_tv(filter, "fence"));
    // Measured 40 and 8.5: one filter swaps front and back, the other gives still things their tile's motion.
    assert_worse(
        "fence in mcguire:motion_blur_demo",
        fence("mcguire:motion_blur_demo"),
        10.0,
    );
    assert_worse("fence in jimenez:o3de", fence("jimenez:o3de"), 4.0);
    // A filter that compares depth keeps the bars: measured 0.013; the wrong filters 0.38 and 0.49.
    let bleed = passing.object_label_tv("jimenez:hdrp", "fence");
    assert!(bleed < 0.04, "{bleed}");
}

#[test]
fn movers_that_share_a_tile_take_one_another_s_motion() {
    let [together, apart] = ["crossing", "crossing@apart"].map(RenderedScene::new);
    let variation = |filter: &str| [&together, &apart].map(|scene| scene.score(filter, "label_tv"));
    // Measured 2.6 and 1.7.
    assert_worse(
        "label_tv of jimenez:slides_2014",
        variation("jimenez:slides_2014"),
        1.8,
    );
    assert_worse("label_tv of mcguire:paper", variation("mcguire:paper"), 1.4);
    // A filter that moves every pixel by itself finds both places equally easy: measured 0.99.
    let [here, there] = [&together, &apart].map(|scene| {
        let (truth, frame) = (scene.truth(Alignment::Centred), &scene.frame);
        let oracle = metrics::scatter_oracle(frame, truth.shutter, &truth.shutter_profile);
        value(&scene.measure(&oracle, Alignment::Centred), "label_tv")
    });
    assert!(here < 1.3 * there, "{here} {there}");
}
