//! Truths and accumulations: stillness, independent halves, sub-frames and their worth, motion
//! masks.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use frame::{Alignment, FAR_DEPTH, Plane, Replicate, Truth};
use glam::{DVec3, Vec3};
use metrics::{Metric, Reference};
use scene::{Background, Parent, Scene, load_scene};
use tests::statistics::{estimate_pixels, expect_pooled_agreement};
use tracer::{Progress, RenderSettings, TruthTracer, trace_ladder};

use crate::renders::*;

const WIDTH: u32 = 48;
const HEIGHT: u32 = 18;
/// Distance at which one metre is one pixel.
const DISTANCE: f64 = 0.5 * HEIGHT as f64;
/// Speed in pixels per frame.
const SPEED: f64 = 16.0;
/// Width of the slab in pixels.
const SLAB: f64 = 5.5;

fn own_settings(samples_per_pixel: u32) -> RenderSettings {
    settings([WIDTH, HEIGHT], samples_per_pixel)
}

/// Makes a tall white slab that moves right through the centre at `t = 0`; `speed` is in pixels per
/// frame.
fn slab_scene(speed: f64) -> Scene {
    let mut scene = empty_scene("slab");
    let motion = drift(DVec3::new(0.0, 0.0, -DISTANCE), speed * DVec3::X);
    let slab = rectangle(SLAB as f32, 100.0);
    add(&mut scene, slab, glowing(1.0), motion);
    scene
}

#[test]
fn the_truth_of_a_still_scene_is_its_frame() {
    let mut scene = empty_scene("still");
    scene.background = Background::Constant(Vec3::splat(0.3));
    scene.sun = sun(DVec3::new(0.6, 0.64, 0.48), 1.0, 0.05);
    for (mesh, material, [x, z]) in [
        (icosphere(1.2, 2), diffuse(0.7), [-2.0, -5.0]),
        (cuboid(Vec3::splat(1.5)), diffuse(0.4), [2.0, -5.0]),
        (rectangle(4.0, 1.0), glowing(0.8), [0.0, -6.0]),
    ] {
        add(&mut scene, mesh, material, placed(DVec3::new(x, 0.0, z)));
    }
    let truth = render_truth(&scene, &own_settings(512), Alignment::Trailing);
    let frame = render_frame(&scene, &own_settings(512));
    // The frame has as many samples as the truth, in one set, so it has at most the truth's noise.
    let mut against_frame = estimate_pixels(&truth, |x, y| f64::from(frame.color.at(x, y)[0]));
    for estimate in &mut against_frame {
        estimate.error *= std::f64::consts::SQRT_2;
    }
    expect_pooled_agreement("still", &against_frame);
    assert!(truth.motion.pixels.iter().all(|motion| *motion == 0.0));
    for (of_frame, of_truth) in frame.coverage.iter().zip(truth.mean().coverage) {
        for (of_frame, of_truth) in of_frame.pixels.iter().zip(of_truth.pixels) {
            // Edges of still objects: rms 0.005 at 512 samples (measured); the largest of 864
            // pixels is four times that.
            assert!((of_frame - of_truth).abs() < 0.03);
        }
    }
}

#[test]
fn halves_are_independent() {
    let settings = own_settings(512);
    let scene = slab_scene(SPEED);
    let truth = render_truth(&scene, &settings, Alignment::Trailing);
    let ladder = render_ladder(&scene, &settings, &truth, &[1]);
    // The slab's smear is a trapezoid, equal in every row. The mean over rows gives its exact
    // value, with 1/4 of the noise.
    let errors = |coverage: &Plane| -> Vec<f64> {
        let columns = (0..WIDTH).flat_map(|x| {
            let column = (0..HEIGHT).map(move |y| f64::from(*coverage.at(x, y)));
            let mean = column.clone().sum::<f64>() / f64::from(HEIGHT);
            column.map(move |value| value - mean)
        });
        columns.collect()
    };
    let halves = truth.halves.iter().chain(&ladder.rungs[0].groups);
    let sets: Vec<Vec<f64>> = halves.map(|half| errors(&half.coverage[1])).collect();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for (number, a) in sets.iter().enumerate() {
        for b in &sets[..number] {
            let correlation = product(a, b) / (product(a, a) * product(b, b)).sqrt();
            // About 400 noisy pixels: the correlation of unrelated numbers has a sigma of 0.05.
            assert!(correlation.abs() < 0.2, "set {number}: {correlation}");
        }
    }
}

#[test]
fn offsets_of_replicates_are_halves_and_those_of_their_mean_are_not() {
    let scene = slab_scene(SPEED);
    let settings = own_settings(64);
    let tracer = TruthTracer::new(&scene, &settings, &[Alignment::Trailing]).expect("allowed");
    let trace = |index| tracer.trace(index, &unwatched).expect("allowed").remove(0);
    let replicates: Vec<Replicate> = (0..settings.replicates).map(trace).collect();
    for Replicate { at_instant, .. } in &replicates {
        assert_eq!(at_instant.clone().rounded(), *at_instant);
    }
    let truth = Truth::of(&replicates).expect("they are whole");
    for at_instant in [&truth.at_instant[0], &truth.at_instant_mean()] {
        assert_ne!(at_instant.clone().rounded(), *at_instant);
    }
}

#[test]
fn a_ladder_s_rungs_average_midpoint_instants() {
    let scene = slab_scene(SPEED);
    let settings = own_settings(512);
    let truth = render_truth(&scene, &settings, Alignment::Leading);
    let subframes = [1, 2, 4, 8];
    let ladder = render_ladder(&scene, &settings, &truth, &subframes);
    assert!(ladder.provenance.samples_per_pixel >= 64);
    assert!(ladder.rungs.iter().map(|rung| rung.subframes).eq(subframes));
    for rung in &ladder.rungs {
        let count = f64::from(rung.subframes);
        let exact = |x: u32| {
            let left = f64::from(x) - 0.5 * f64::from(WIDTH);
            let covered = (0..rung.subframes).map(|part| {
                let slab = SPEED * (f64::from(part) + 0.5) / count - 0.5 * SLAB;
                ((left + 1.0).min(slab + SLAB) - left.max(slab)).max(0.0)
            });
            covered.sum::<f64>() / count
        };
        let exact: Vec<f64> = (0..WIDTH).map(exact).collect();
        for group in &rung.groups {
            let picture = truth.mean().plus(group);
            let rows = picture.coverage[1].pixels.chunks(WIDTH as usize);
            let off = rows.flat_map(|row| row.iter().zip(&exact));
            let off = off.map(|(actual, exact)| f64::from(*actual) - exact);
            let squares: f64 = off.map(|off| off * off).sum();
            let rms = (squares / f64::from(WIDTH * HEIGHT)).sqrt();
            // Still edges at 32 samples and more: 0.02 (prototype), and few pixels are edges.
            assert!(rms < 0.02, "{count} sub-frames: rms {rms}");
        }
    }
}

#[test]
fn a_ladder_equals_the_truth_at_still_pixels_and_costs_no_more() {
    let mut scene = slab_scene(2.0);
    // Columns 13.2 to 18.4: the moving slab does not reach the left edge, but reaches the right
    // one.
    let panel = placed(DVec3::new(-8.2, 0.1, -DISTANCE));
    add(&mut scene, rectangle(5.2, 30.0), glowing(0.5), panel);
    let settings = own_settings(512);
    let truth = render_truth(&scene, &settings, Alignment::Trailing);
    let work = AtomicU64::new(0);
    let watch = |progress: Progress| {
        work.store(progress.total, Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    let ladder =
        trace_ladder(&scene, &settings, &truth, &measure::LADDER, &watch).expect("allowed");
    let whole = u64::from(WIDTH * HEIGHT * settings.samples_per_pixel);
    assert!(work.into_inner() <= whole);
    // The slab sweeps 19.25 to 26.75. In the margin around it, only the still panel's edge is
    // noisy, and both pictures alike.
    for rung in &ladder.rungs {
        for group in &rung.groups {
            let differs = |x: u32| (0..HEIGHT).any(|y| *group.color.at(x, y) != [0.0; 3]);
            assert!((0..19).chain(27..WIDTH).all(|x| !differs(x)));
        }
    }
    let differs = |rung: usize| ladder.rungs[rung].groups[0].color.at(19, 0) != &[0.0; 3];
    assert!(differs(0), "a still edge is no part of a smear");
}

#[test]
fn the_motion_mask_is_the_coverage_of_objects_that_move_on_screen() {
    let mut scene = slab_scene(SPEED);
    scene.exposure = 0.5;
    for x in [-15.0, 15.0] {
        let still = placed(DVec3::new(x, 0.0, -DISTANCE));
        add(&mut scene, rectangle(4.0, 4.0), glowing(1.0), still);
    }
    // A dashboard.
    scene.objects[2].parent = Parent::Camera;
    let along = drift(DVec3::ZERO, SPEED * DVec3::X);
    // Camera still, moving along, turning.
    for (camera, moving) in [
        (placed(DVec3::ZERO), [false, true, false, false]),
        (along, [false, false, true, false]),
        (spin(DVec3::ZERO, DVec3::Y, 0.2), [true, true, true, false]),
    ] {
        scene.camera.motion = camera;
        let truth = render_truth(&scene, &own_settings(32), Alignment::Centred);
        let mean = truth.mean().coverage;
        for (pixel, motion) in truth.motion.pixels.iter().enumerate() {
            let moving = mean.iter().zip(moving).filter(|(_, moves)| *moves);
            let expected: f32 = moving.map(|(coverage, _)| coverage.pixels[pixel]).sum();
            assert!((motion - expected).abs() < 1e-6);
        }
    }
}

#[test]
fn a_frame_holds_the_instant_and_not_the_shutter() {
    let frame = render_frame(&slab_scene(SPEED), &own_settings(1));
    for (x, y) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
        let place = f64::from(x) + 0.5 - 0.5 * f64::from(WIDTH);
        let inside = place.abs() < 0.5 * SLAB;
        assert_eq!(*frame.object_id.at(x, y), u32::from(inside));
        let depth = if inside { DISTANCE as f32 } else { FAR_DEPTH };
        assert!((frame.depth.at(x, y) / depth - 1.0).abs() < 1e-6);
        let velocity = if inside { SPEED } else { 0.0 };
        assert!((f64::from(frame.velocity.at(x, y)[0]) - velocity).abs() < 1e-5);
    }
}

#[test]
fn n_subframes_are_worth_n() {
    let folder = tests::scenes().join("sliding_panel");
    // 128 px per frame at 640x360 are 8 px over this shutter and size: 8 sub-frames are a pixel
    // apart, each count's error well above noise.
    let scene = load_scene(&folder, Some("128px_30deg")).unwrap();
    let mut settings = settings([80, 45], 512);
    settings.exposure = Some(1.0);
    let mut coarse = settings;
    coarse.samples_per_pixel = 64;
    let frame = render_frame(&scene, &coarse);
    let truth = render_truth(&scene, &settings, Alignment::Trailing);
    let ladder = render_ladder(&scene, &settings, &truth, &measure::LADDER);
    let reference = Reference::new(&frame, &truth, Some(&ladder), &scene.display.into()).unwrap();
    // Another seed than the reference's.
    let mut again = settings;
    again.seed = 2;
    let other = render_truth(&scene, &again, Alignment::Trailing);
    for rung in render_ladder(&scene, &again, &other, &[2, 4, 8]).rungs {
        let measured = reference.measure(&rung.picture(&other.mean()));
        let scores = measured.unwrap().scores;
        let n = f64::from(rung.subframes);
        let count = scores.get(Metric::SUBFRAMES).value().unwrap();
        expect_near(&format!("{n} sub-frames"), count, n, 0.05 * n);
    }
}
