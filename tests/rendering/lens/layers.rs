//! A lens's effect on frames and truths, and what it leaves unchanged.

use frame::{Alignment, Truth};
use glam::DVec3;
use scene::{Background, Finish, Scene};
use tracer::{LadderTracer, RenderSettings};

use super::with_lens;
use crate::regions::expect_support;
use crate::renders::*;

fn settings(samples_per_pixel: u32) -> RenderSettings {
    settings_of_two([32, 18], samples_per_pixel)
}

/// Returns `fan` with a lens focused in front of it.
fn fan() -> Scene {
    with_lens(load_shipped("fan"), 0.3, 3.0)
}

#[test]
fn velocity_depth_and_objects_of_a_frame_are_the_pinhole_s() {
    let [lens, pinhole, shipped] = [fan(), fan().pinhole(), load_shipped("fan")]
        .map(|scene| render_frame(&scene, &settings(16)));
    assert_ne!(lens.color, pinhole.color);
    assert_ne!(lens.coverage, pinhole.coverage);
    assert_eq!(lens.velocity, pinhole.velocity);
    assert_eq!(lens.depth, pinhole.depth);
    assert_eq!(lens.object_id, pinhole.object_id);
    // Without its lens the scene equals the one that never had one.
    assert_eq!(shipped, pinhole);
}

#[test]
fn where_next_to_nothing_moves_everything_is_known_and_in_its_place() {
    let mut scene = empty_scene("still");
    scene.background = Background::Constant(glam::Vec3::splat(0.4));
    let floor = placed(DVec3::new(0.0, 0.0, -6.0));
    add(&mut scene, rectangle(40.0, 40.0), diffuse(0.6), floor);
    // Gloss changes with the viewpoint, so nothing is treated as unchanging.
    let mut glossy = diffuse(0.8);
    glossy.finish = Finish::Conductor { roughness: 0.2 };
    let near = placed(DVec3::new(0.2, 0.1, -2.0));
    add(&mut scene, icosphere(0.5, 2), glossy, near);
    zoom_slightly(&mut scene);
    let scene = with_lens(scene, 0.5, 4.0);
    let truth = render_truth(&scene, &settings(256), Alignment::Trailing);
    let known = truth.at_instant_mean();
    let [live, frozen] = [truth.mean().color, truth.frozen_mean()];
    for pixel in 0..known.unknowable.pixels.len() {
        assert_eq!(known.unknowable.pixels[pixel], 0.0);
        // Only the samples' own positions in the pixel remain, which are spread evenly.
        for axis in 0..2 {
            let [offset, spread] = [&known.offset, &known.spread].map(|layer| layer.pixels[pixel]);
            expect_near("offset", offset[axis].into(), 0.0, 0.01);
            expect_near("spread", spread[axis].into(), 1.0 / 12.0, 0.01);
        }
        // Shading from the same point of the lens is the same, except for rounding of the ray.
        let [frozen, live] = [frozen.pixels[pixel][0], live.pixels[pixel][0]];
        assert!((frozen - live).abs() < 1e-4, "{frozen} {live}");
    }
    assert!(!truth.support.unknowable.pixels.contains(&true));
}

#[test]
fn the_support_holds_nearly_all_that_the_lens_spreads() {
    let truth = render_truth(&fan(), &settings(128), Alignment::Trailing);
    expect_support("fan", &truth);
    // The fan's blades reach beyond where the pinhole sees them.
    let sharp = render_truth(&load_shipped("fan"), &settings(4), Alignment::Trailing);
    let count = |truth: &Truth| {
        truth
            .support
            .moving
            .pixels
            .iter()
            .filter(|moves| **moves)
            .count()
    };
    let [lens, pinhole] = [&truth, &sharp].map(count);
    assert!(lens as f64 > 1.1 * pinhole as f64, "{lens} {pinhole}");
}

#[test]
fn sub_frames_have_the_lens() {
    // A large aperture, which shows above the noise of few samples.
    let scene = with_lens(load_shipped("fan"), 1.2, 3.0);
    let settings = settings_of_two([32, 18], 256);
    let truth = render_truth(&scene, &settings, Alignment::Centred);
    // One sub-frame in the shutter's middle is the truth of a short shutter around the instant.
    let short = RenderSettings {
        exposure: Some(1e-3),
        ..settings
    };
    let instant = render_truth(&scene, &short, Alignment::Centred)
        .mean()
        .color;
    let ladder = render_ladder(&scene, &settings, &truth, &[1]);
    let sharp = render_ladder(&scene.clone().pinhole(), &settings, &truth, &[1]);
    let [with, without] = [&ladder, &sharp]
        .map(|ladder| rms_difference(&ladder.rungs[0].picture(&truth.mean()).color, &instant));
    assert!(with < 0.02 && without > 2.0 * with, "{with} {without}");
    let ladder_tracer = LadderTracer::new(&scene, &settings, &truth, &[1]).unwrap();
    assert_eq!(ladder_tracer.trace(1, &unwatched).unwrap(), ladder);
}
