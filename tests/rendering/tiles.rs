//! Tiles of frames, replicates and rungs, rendered alone: they equal the same part of the whole.

use frame::{Alignment, AtInstant, Replicate, Tile, Truth, VelocityKind};
use tracer::{LadderTracer, PixelGrid, RenderSettings, TruthTracer, trace_frame_part};

use crate::lens::with_lens;
use crate::renders::*;

fn settings() -> RenderSettings {
    let mut settings = settings_of_two([40, 24], 32);
    settings.guard_band = 3;
    settings.exposure = Some(0.3);
    settings.options.velocity = VelocityKind::PreviousFrame;
    settings
}

/// Tiles at the corners, inside, of one pixel, and the whole of a picture.
fn tiles(width: u32, height: u32) -> [Tile; 5] {
    let corner = [width - 5, height - 7, 5, 7];
    let (inside, pixel, whole) = ([9, 6, 16, 12], [17, 11, 1, 1], [0, 0, width, height]);
    let places = [[0, 0, 8, 8], corner, inside, pixel, whole];
    places.map(|[x, y, width, height]| Tile {
        x,
        y,
        width,
        height,
    })
}

/// Cuts a tile out of a replicate.
fn part(whole: &Replicate, tile: Tile) -> Replicate {
    let all = &whole.at_instant;
    Replicate {
        picture: whole.picture.part(tile),
        samples: whole.samples.part(tile),
        support: whole.support.part(tile),
        at_instant: AtInstant {
            shift: all.shift.part(tile),
            unknowable: all.unknowable.part(tile),
            placed: all.placed.part(tile),
            offset: all.offset.part(tile),
            spread: all.spread.part(tile),
        },
        ..whole.clone()
    }
}

#[test]
fn a_tile_of_a_replicate_holds_what_the_replicate_holds_there() {
    let fan = load_shipped("fan");
    for scene in [with_lens(fan.clone(), 0.3, 3.0), fan] {
        // Each tracer has its own pilot and support.
        let tracer = |alignments: &[Alignment]| {
            TruthTracer::new(&scene, &settings(), alignments).expect("settings are allowed")
        };
        let both = [Alignment::Trailing, Alignment::Centred];
        let whole = tracer(&both).trace(1, &unwatched).unwrap();
        let of_tiles = tracer(&both);
        for tile in tiles(40, 24) {
            let parts = of_tiles.trace_tile(1, tile, &unwatched).unwrap();
            for (actual, whole) in parts.iter().zip(&whole) {
                assert_eq!(*actual, part(whole, tile), "{tile:?}");
            }
        }
        // The replicates of an alignment join to its truth, which is rendered alone.
        let first = tracer(&both).trace(0, &unwatched).unwrap().remove(0);
        let truth = render_truth(&scene, &settings(), Alignment::Trailing);
        let joined = Truth::of(&[first, whole[0].clone()]).unwrap();
        assert_eq!(joined.mean(), truth.mean());
        assert_eq!(joined.standard_error, truth.standard_error);
    }
}

#[test]
fn a_tile_of_a_frame_holds_what_the_frame_holds_there() {
    let scene = load_shipped("fan");
    let mut settings = settings();
    settings.replicates = 1;
    let whole = render_frame(&scene, &settings);
    let grid = PixelGrid::of_picture(settings.width, settings.height);
    for tile in tiles(46, 30) {
        let part = trace_frame_part(&scene, &settings, &grid, Some(tile), &unwatched).unwrap();
        let part = part.frame;
        assert_eq!(part.picture(), whole.picture().part(tile), "{tile:?}");
        assert_eq!(part.velocity, whole.velocity.part(tile));
        assert_eq!(part.depth, whole.depth.part(tile));
        assert_eq!(part.object_id, whole.object_id.part(tile));
        let samples = whole.samples.as_ref().map(|plane| plane.part(tile));
        assert_eq!(part.samples, samples);
        assert_eq!(part.provenance, whole.provenance);
        assert_eq!(part.camera, whole.camera);
        assert_eq!(part.reprojection, whole.reprojection);
    }
}

#[test]
fn a_tile_of_a_rung_holds_what_the_rung_holds_there() {
    let scene = load_shipped("fan");
    let settings = settings();
    let truth = render_truth(&scene, &settings, Alignment::Trailing);
    let tracer = LadderTracer::new(&scene, &settings, &truth, &[2, 8]).unwrap();
    let whole = tracer.trace(8, &unwatched).unwrap();
    // Some of these pixels are rendered.
    let colors = &whole.rungs[0].groups[0].color.pixels;
    assert!(colors.iter().any(|color| *color != [0.0; 3]));
    for tile in tiles(40, 24) {
        let part = tracer.trace_tile(8, tile, &unwatched).unwrap();
        for (group, all) in part.rungs[0].groups.iter().zip(&whole.rungs[0].groups) {
            assert_eq!(*group, all.part(tile), "{tile:?}");
        }
        assert_eq!(part.provenance, whole.provenance);
    }
}
