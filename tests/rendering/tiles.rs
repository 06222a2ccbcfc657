//! Tiles of frames, replicates and rungs, rendered alone: they hold what the whole holds there.

use frame::{Alignment, Tile, VelocityKind};
use tests::{scenes, unwatched};
use tracer::{
    LadderTracer, PixelGrid, RenderSettings, TruthTracer, load_scene, trace_frame,
    trace_frame_part, trace_truth,
};

fn settings() -> RenderSettings {
    let mut settings = RenderSettings {
        width: 40,
        height: 24,
        samples_per_pixel: 32,
        replicates: 2,
        guard_band: 3,
        ..RenderSettings::default()
    };
    settings.options.velocity = VelocityKind::PreviousFrame;
    settings
}

/// Tiles at the corners, inside, of one pixel, and the whole of a picture.
fn tiles(width: u32, height: u32) -> [Tile; 5] {
    let tile = |x, y, width, height| Tile {
        x,
        y,
        width,
        height,
    };
    [
        tile(0, 0, 8, 8),
        tile(width - 5, height - 7, 5, 7),
        tile(9, 6, 16, 12),
        tile(17, 11, 1, 1),
        Tile::whole(width, height),
    ]
}

#[test]
fn a_tile_of_a_replicate_holds_what_the_replicate_holds_there() {
    for scene in ["fan", "two_spheres"] {
        let scene = load_scene(scenes().join(scene), None).unwrap();
        let alignments = [Alignment::Trailing, Alignment::Centred];
        let trace = |tile: Option<Tile>| {
            // Each has a pilot and a support of its own.
            let tracer = TruthTracer::new(&scene, &settings(), &alignments).unwrap();
            match tile {
                None => tracer.trace(1, &unwatched).unwrap(),
                Some(tile) => tracer.trace_tile(1, tile, &unwatched).unwrap(),
            }
        };
        let whole = trace(None);
        for tile in tiles(40, 24) {
            for (part, whole) in trace(Some(tile)).iter().zip(&whole) {
                assert_eq!(part.picture, whole.picture.part(tile), "{tile:?}");
                assert_eq!(part.samples, whole.samples.part(tile));
                assert_eq!(part.support, whole.support.part(tile));
                let [own, all] = [&part.at_instant, &whole.at_instant];
                assert_eq!(own.frozen, all.frozen.part(tile));
                assert_eq!(own.offset, all.offset.part(tile));
                assert_eq!(own.spread, all.spread.part(tile));
                assert_eq!(own.placed, all.placed.part(tile));
                assert_eq!(own.unknowable, all.unknowable.part(tile));
                assert_eq!(part.provenance, whole.provenance);
                assert_eq!(part.moving, whole.moving);
            }
        }
    }
}

#[test]
fn a_tile_of_a_frame_holds_what_the_frame_holds_there() {
    let scene = load_scene(scenes().join("fan"), None).unwrap();
    let settings = RenderSettings {
        replicates: 1,
        ..settings()
    };
    let whole = trace_frame(&scene, &settings, &unwatched).unwrap();
    let grid = PixelGrid::of_picture(settings.width, settings.height);
    for tile in tiles(46, 30) {
        let part = trace_frame_part(&scene, &settings, &grid, Some(tile), &unwatched).unwrap();
        assert_eq!(part.color, whole.color.part(tile), "{tile:?}");
        assert_eq!(part.velocity, whole.velocity.part(tile));
        assert_eq!(part.depth, whole.depth.part(tile));
        assert_eq!(part.object_id, whole.object_id.part(tile));
        let coverage: Vec<_> = whole
            .coverage
            .iter()
            .map(|plane| plane.part(tile))
            .collect();
        assert_eq!(part.coverage, coverage);
        let samples = whole.samples.as_ref().map(|plane| plane.part(tile));
        assert_eq!(part.samples, samples);
        assert_eq!(part.provenance, whole.provenance);
        assert_eq!(part.camera, whole.camera);
        assert_eq!(part.reprojection, whole.reprojection);
    }
}

#[test]
fn a_tile_of_a_rung_holds_what_the_rung_holds_there() {
    let scene = load_scene(scenes().join("fan"), None).unwrap();
    let settings = settings();
    let truth = trace_truth(&scene, &settings, Alignment::Trailing, &unwatched).unwrap();
    let tracer = LadderTracer::new(&scene, &settings, &truth, &[2, 8]).unwrap();
    let whole = tracer.trace(8, &unwatched).unwrap();
    // Some of these pixels are rendered, and others hold the truth's mean.
    assert_ne!(whole.rungs[0].halves[0], truth.mean());
    for tile in tiles(40, 24) {
        let part = tracer.trace_tile(8, tile, &unwatched).unwrap();
        for (own, all) in part.rungs[0].halves.iter().zip(&whole.rungs[0].halves) {
            assert_eq!(*own, all.part(tile), "{tile:?}");
        }
        assert_eq!(part.provenance, whole.provenance);
    }
}
