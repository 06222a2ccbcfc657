//! Errors of accumulated sub-frames, the unit of the headline score.

use frame::{Alignment, Picture};
use metrics::{Metric, Reference};
use tracer::load_scene;

use crate::renders::{expect_near, render_frame, render_ladder, render_truth, settings};

#[test]
fn n_subframes_are_worth_n() {
    let folder = tests::scenes().join("sliding_panel");
    // 128 px per frame at 640x360 are 8 px over this shutter and size: 8 sub-frames are a pixel apart, so the error of each count is
    // well above the noise.
    let scene = load_scene(&folder, Some("128px_30deg")).unwrap();
    let mut settings = settings([80, 45], 512);
    settings.exposure = Some(1.0);
    let mut coarse = settings;
    coarse.samples_per_pixel = 64;
    let frame = render_frame(&scene, &coarse);
    let truth = render_truth(&scene, &settings, Alignment::Trailing);
    let ladder = render_ladder(&scene, &settings, &truth, &store::LADDER);
    let reference = Reference::new(&frame, &truth, Some(&ladder), &scene.display.into()).unwrap();
    // Another seed than the reference's.
    let mut again = settings;
    again.seed = 2;
    for rung in render_ladder(&scene, &again, &truth, &[2, 4, 8]).rungs {
        let measured = reference.measure(&Picture::mean(&rung.halves));
        let scores = measured.unwrap().scores;
        let n = f64::from(rung.subframes);
        let found = scores.get(Metric::SUBFRAMES).value().unwrap();
        expect_near(&format!("{n} sub-frames"), found, n, 0.05 * n);
    }
}
