//! What a lens changes of frames and truths, and what it leaves.

use std::slice;

use frame::{Alignment, Tile, Truth};
use glam::{DVec3, Vec3};
use tests::shapes::*;
use tests::unwatched;
use tracer::{
    Finish, LadderTracer, Lens, Material, RenderSettings, Scene, TruthTracer, frame_hash,
    ladder_hash, load_scene, trace_frame, trace_ladder, trace_truth, truth_hash,
};

use super::with_lens;

fn settings() -> RenderSettings {
    RenderSettings {
        width: 48,
        height: 27,
        samples_per_pixel: 256,
        replicates: 2,
        ..RenderSettings::default()
    }
}

fn load_shipped(name: &str) -> Scene {
    load_scene(tests::scenes().join(name), None).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns `fan` with a lens that is focused before it.
fn fan() -> Scene {
    with_lens(load_shipped("fan"), 0.3, 3.0)
}

#[test]
fn velocity_depth_and_objects_of_a_frame_are_the_pinhole_s() {
    let lens = trace_frame(&fan(), &settings(), &unwatched).unwrap();
    let pinhole = trace_frame(&fan().pinhole(), &settings(), &unwatched).unwrap();
    assert_ne!(lens.color, pinhole.color);
    assert_ne!(lens.coverage, pinhole.coverage);
    assert_eq!(lens.velocity, pinhole.velocity);
    assert_eq!(lens.depth, pinhole.depth);
    assert_eq!(lens.object_id, pinhole.object_id);
    // Without its lens the scene is the one that never had one.
    let shipped = trace_frame(&load_shipped("fan"), &settings(), &unwatched).unwrap();
    assert_eq!(shipped, pinhole);
}

/// Makes a still scene. Its gloss changes with the place that it is seen from, so that nothing is taken for unchanging.
fn still_scene() -> Scene {
    let mut scene = empty_scene("still");
    scene.background = tracer::Background::Constant(Vec3::splat(0.4));
    let glossy = Material {
        finish: Finish::Conductor { roughness: 0.2 },
        ..diffuse(0.8)
    };
    let floor = placed(DVec3::new(0.0, 0.0, -6.0));
    add(&mut scene, rectangle(40.0, 40.0), diffuse(0.6), floor);
    let near = placed(DVec3::new(0.2, 0.1, -2.0));
    add(&mut scene, icosphere(0.5, 2), glossy, near);
    with_lens(scene, 0.5, 4.0)
}

#[test]
fn where_nothing_moves_everything_is_known_and_in_its_place() {
    let truth = trace_truth(&still_scene(), &settings(), Alignment::Trailing, &unwatched).unwrap();
    let known = truth.at_instant_mean();
    let mean = truth.mean();
    for pixel in 0..known.unknowable.pixels.len() {
        assert_eq!(known.unknowable.pixels[pixel], 0.0);
        let [x, y] = known.offset.pixels[pixel];
        // The mean of stratified places in a pixel, of 32 at least.
        assert!(x.abs() < 0.03 && y.abs() < 0.03, "{x} {y}");
        let [xx, _, yy] = known.spread.pixels[pixel];
        let square = 1.0 / 12.0;
        assert!((xx - square).abs() < 0.02 && (yy - square).abs() < 0.02);
        // Shading from the same point of the lens is the same, but for rounding of the ray.
        let [frozen, live] = [known.frozen.pixels[pixel][0], mean.color.pixels[pixel][0]];
        assert!((frozen - live).abs() < 1e-4, "{frozen} {live}");
    }
    assert!(
        truth
            .support
            .unknowable
            .pixels
            .iter()
            .all(|unknown| !unknown)
    );
}

#[test]
fn the_support_holds_nearly_all_that_the_lens_spreads() {
    let truth = trace_truth(&fan(), &settings(), Alignment::Trailing, &unwatched).unwrap();
    let mean = truth.mean();
    for (object, seen) in truth.support.seen.iter().enumerate() {
        let matte = &mean.coverage[object].pixels;
        let sum = |wanted: bool| -> f64 {
            (matte.iter().zip(&seen.pixels))
                .filter(|(_, seen)| **seen == wanted)
                .map(|(matte, _)| f64::from(*matte))
                .sum()
        };
        let (missed, held) = (sum(false), sum(true));
        assert!(
            missed <= 0.005 * (missed + held) + 0.01,
            "object {object}: {missed}"
        );
    }
    // The fan's blades reach beyond where the pinhole sees them.
    let sharp = trace_truth(
        &load_shipped("fan"),
        &settings(),
        Alignment::Trailing,
        &unwatched,
    );
    let count = |truth: &Truth| truth.support.moving.pixels.iter().filter(|it| **it).count();
    let [lens, pinhole] = [&truth, &sharp.unwrap()].map(count);
    assert!(lens as f64 > 1.1 * pinhole as f64, "{lens} {pinhole}");
}

#[test]
fn sub_frames_have_the_lens() {
    let truth = trace_truth(&fan(), &settings(), Alignment::Trailing, &unwatched).unwrap();
    let ladder = trace_ladder(&fan(), &settings(), &truth, &[64], &unwatched).unwrap();
    let mean = truth.mean();
    let apart = |of: &[frame::Picture; 2]| {
        let found = frame::Picture::mean(of);
        let pairs = found.color.pixels.iter().zip(&mean.color.pixels);
        let squares = pairs
            .map(|(a, b)| f64::from(a[0] - b[0]).powi(2))
            .sum::<f64>();
        (squares / found.color.pixels.len() as f64).sqrt()
    };
    let with = apart(&ladder.rungs[0].halves);
    let sharp = trace_ladder(&fan().pinhole(), &settings(), &truth, &[64], &unwatched).unwrap();
    let without = apart(&sharp.rungs[0].halves);
    assert!(with < 0.02 && without > 2.0 * with, "{with} {without}");
    let scene = fan();
    let own = LadderTracer::new(&scene, &settings(), &truth, &[64]);
    assert_eq!(own.unwrap().trace(64, &unwatched).unwrap(), ladder);
}

#[test]
fn replicates_and_tiles_of_a_lens_join_as_those_of_a_pinhole() {
    let scene = fan();
    let both = [Alignment::Trailing, Alignment::Centred];
    let tracer = TruthTracer::new(&scene, &settings(), &both).unwrap();
    let whole = tracer.trace(1, &unwatched).unwrap();
    let alone = TruthTracer::new(&scene, &settings(), &both[1..]).unwrap();
    assert_eq!(alone.trace(1, &unwatched).unwrap(), whole[1..]);
    let tile = Tile {
        x: 10,
        y: 5,
        width: 7,
        height: 9,
    };
    let part = tracer.trace_tile(1, tile, &unwatched).unwrap();
    assert_eq!(part[0].picture, whole[0].picture.part(tile));
    let truth = trace_truth(&scene, &settings(), Alignment::Trailing, &unwatched).unwrap();
    let first = tracer.trace(0, &unwatched).unwrap();
    let joined = Truth::of(&[first[0].clone(), whole[0].clone()]).unwrap();
    assert_eq!(joined.mean(), truth.mean());
    assert_eq!(joined.standard_error, truth.standard_error);
}

#[test]
fn hashes_cover_the_lens() {
    let scenes = [
        load_shipped("fan"),
        fan(),
        with_lens(load_shipped("fan"), 0.31, 3.0),
        with_lens(load_shipped("fan"), 0.3, 3.1),
    ];
    let hashes = |scene: &Scene| {
        let settings = settings();
        [
            frame_hash(scene, &settings),
            truth_hash(scene, &settings, Alignment::Trailing),
            ladder_hash(scene, &settings, Alignment::Trailing, slice::from_ref(&4)),
        ]
    };
    let mut all: Vec<String> = scenes.iter().flat_map(hashes).collect();
    all.sort_unstable();
    all.dedup();
    assert_eq!(all.len(), 12);
    assert_eq!(hashes(&fan().pinhole()), hashes(&scenes[0]));
    assert_eq!(
        fan().camera.lens,
        Some(Lens {
            aperture: 0.3,
            focus: 3.0
        })
    );
}
