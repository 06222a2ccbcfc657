//! Worth of accumulated sub-frames, the unit of the headline score.

use frame::{Alignment, Picture};
use metrics::Reference;
use tests::unwatched;
use tracer::{RenderSettings, load_scene, trace_frame, trace_ladder, trace_truth};

#[test]
fn n_subframes_are_worth_n() {
    let folder = tests::scenes().join("sliding_panel");
    // 128 px per frame at 640x360 are 16 px over this shutter and size: 16 sub-frames lie a pixel apart, so that the
    // error of each count is well above the noise.
    let scene = load_scene(&folder, Some("128px_30deg")).unwrap();
    let watch = &unwatched;
    let settings = RenderSettings {
        width: 160,
        height: 90,
        exposure: Some(1.0),
        samples_per_pixel: 1024,
        ..RenderSettings::default()
    };
    let coarse = RenderSettings {
        samples_per_pixel: 64,
        ..settings
    };
    let frame = trace_frame(&scene, &coarse, watch).unwrap();
    let truth = trace_truth(&scene, &settings, Alignment::Trailing, watch).unwrap();
    let ladder = trace_ladder(&scene, &settings, &truth, &store::LADDER, watch).unwrap();
    let reference = Reference::new(&frame, &truth, Some(&ladder), &scene.display.into()).unwrap();
    // Another seed than the reference's.
    let again = RenderSettings {
        seed: 2,
        ..settings
    };
    let measured = trace_ladder(&scene, &again, &truth, &[2, 4, 8, 16], watch).unwrap();
    for rung in measured.rungs {
        let picture = Picture::mean(&rung.halves);
        let scores = reference.measure(&picture).unwrap().scores;
        let n = f64::from(rung.subframes);
        let found = scores.get(metrics::Metric::SUBFRAMES).value().unwrap();
        println!("{n} sub-frames are worth {found:.3}");
        assert!(
            (found / n - 1.0).abs() < 0.05,
            "{n} sub-frames are worth {found}"
        );
    }
}
