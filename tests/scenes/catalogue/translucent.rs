//! Things that light passes and velocity does not know.

use super::assert_worse;
use super::rendered_scene::{RenderedScene, small_settings};
use tracer::RenderSettings;

fn render(name: &str) -> RenderedScene {
    let settings = RenderSettings {
        width: 120,
        height: 68,
        ..small_settings()
    };
    RenderedScene::with_settings(name, settings)
}

#[test]
fn a_glass_door_without_velocity_stays_sharp_and_a_ball_behind_panes_smears_their_print() {
    let scenes = ["glasshouse", "glasshouse@written", "glasshouse@resting"].map(render);
    for filter in ["jump_flood:corrected", "jimenez:hdrp", "mcguire:paper"] {
        let [plain, written, resting] = &scenes;
        let door = [plain, written].map(|scene| scene.object_label_tv(filter, "door"));
        assert_worse(&format!("door in {filter}"), door, 1.1);
        let panes = [plain, resting].map(|scene| scene.object_label_tv(filter, "panes"));
        assert_worse(&format!("panes in {filter}"), panes, 1.1);
    }
}

#[test]
fn sparks_without_velocity_stay_dots() {
    let scenes = ["sparks", "sparks@written", "sparks@opaque"].map(render);
    for filter in ["jump_flood:corrected", "jimenez:hdrp", "mcguire:paper"] {
        let [plain, written, opaque] = scenes
            .each_ref()
            .map(|scene| scene.error_left_by(filter, "label_tv"));
        assert_worse(&format!("label_tv left by {filter}"), [plain, written], 1.1);
        assert_worse(
            &format!("against opaque ones, {filter}"),
            [plain, opaque],
            1.1,
        );
    }
}
