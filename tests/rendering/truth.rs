//! Truths and accumulations: stillness, length and side of a smear, independent halves, sub-frames.

use frame::{Alignment, FAR_DEPTH, Frame, Replicate, Truth};
use glam::{DVec3, Vec3};
use tests::shapes::*;
use tests::statistics::{
    coverage_estimates, estimate_pixels, expect_agreement, expect_pooled_agreement,
};
use tests::unwatched;
use tracer::{
    Background, Motion, Parent, RenderSettings, Scene, Sun, TruthTracer, trace_frame, trace_ladder,
    trace_truth,
};

const WIDTH: u32 = 48;
const HEIGHT: u32 = 18;
/// Distance at which one metre is one pixel.
const DISTANCE: f64 = 0.5 * HEIGHT as f64;
/// Speed in pixels per frame.
const SPEED: f64 = 16.0;
/// Width of the slab in pixels.
const SLAB: f64 = 5.5;

fn render_settings(exposure: f64) -> RenderSettings {
    RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        exposure: Some(exposure),
        samples_per_pixel: 512,
        ..RenderSettings::default()
    }
}

fn render_truth(scene: &Scene, exposure: f64, alignment: Alignment) -> Truth {
    trace_truth(scene, &render_settings(exposure), alignment, &unwatched).expect("allowed")
}

fn render_frame(scene: &Scene) -> Frame {
    trace_frame(scene, &render_settings(1.0), &unwatched).expect("allowed")
}

/// Makes a tall white slab that moves right through the centre at `t = 0`; `speed` is in pixels per frame.
fn slab_scene(speed: f64) -> Scene {
    let mut scene = empty_scene("slab");
    let motion = drift(DVec3::new(0.0, 0.0, -DISTANCE), speed * DVec3::X);
    add(
        &mut scene,
        rectangle(SLAB as f32, 100.0),
        glowing(1.0),
        motion,
    );
    scene
}

/// Returns the centroid and variance along x of an object's coverage, in pixels from the picture's centre.
fn spread(truth: &Truth) -> (f64, f64) {
    let coverage = &truth.mean().coverage[1];
    let mut moments = [0.0; 3];
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let place = f64::from(x) + 0.5 - 0.5 * f64::from(WIDTH);
            for (power, moment) in moments.iter_mut().enumerate() {
                *moment += f64::from(*coverage.at(x, y)) * place.powi(power as i32);
            }
        }
    }
    let centroid = moments[1] / moments[0];
    (centroid, moments[2] / moments[0] - centroid * centroid)
}

#[test]
fn the_truth_of_a_still_scene_is_its_frame() {
    let mut scene = empty_scene("still");
    scene.background = Background::Constant(Vec3::splat(0.3));
    scene.sun = Some(Sun {
        direction: DVec3::new(0.6, 0.64, 0.48),
        irradiance: Vec3::ONE,
        angular_radius: 0.05,
    });
    let at = |x: f64| DVec3::new(x, 0.0, -5.0);
    add(
        &mut scene,
        icosphere(1.2, 2),
        diffuse(0.7),
        placed(at(-2.0)),
    );
    add(
        &mut scene,
        cuboid(Vec3::splat(1.5)),
        diffuse(0.4),
        placed(at(2.0)),
    );
    add(
        &mut scene,
        rectangle(4.0, 1.0),
        glowing(0.8),
        placed(at(0.0) - DVec3::Z),
    );
    let truth = render_truth(&scene, 1.0, Alignment::Trailing);
    let frame = render_frame(&scene);
    // The frame has as many samples as the truth, in one set, and so at most its noise.
    let mut against_frame = estimate_pixels(&truth, |x, y| f64::from(frame.color.at(x, y)[0]));
    for estimate in &mut against_frame {
        estimate.error *= std::f64::consts::SQRT_2;
    }
    expect_pooled_agreement("still", &against_frame);
    assert!(truth.motion.pixels.iter().all(|motion| *motion == 0.0));
    for halves in [0, 1, 2, 3] {
        for (pixel, coverage) in frame.coverage[halves].pixels.iter().enumerate() {
            let of_truth = truth.mean().coverage[halves].pixels[pixel];
            // Edges of still things: rms 0.005 at 512 samples (measured); the largest of 864 pixels is four times that.
            assert!((coverage - of_truth).abs() < 0.03);
        }
    }
}

#[test]
fn half_the_exposure_gives_half_the_smear() {
    let scene = slab_scene(SPEED);
    for exposure in [1.0, 0.5] {
        let (_, variance) = spread(&render_truth(&scene, exposure, Alignment::Centred));
        // The smear, the slab and the pixel are three boxes. Their variances add, each its squared width over 12.
        let smear = (12.0 * variance - SLAB * SLAB - 1.0).sqrt();
        // Noise of the second moment: 2e-4 of it.
        assert!(
            (smear / (SPEED * exposure) - 1.0).abs() < 2e-3,
            "smear is {smear} pixels"
        );
    }
}

#[test]
fn the_smear_lies_on_the_shutter_s_side() {
    let scene = slab_scene(SPEED);
    let middles = [
        (Alignment::Trailing, -0.5),
        (Alignment::Centred, 0.0),
        (Alignment::Leading, 0.5),
    ];
    for (alignment, middle) in middles {
        let (centroid, _) = spread(&render_truth(&scene, 0.8, alignment));
        // Noise of the centroid: 2e-3 pixels.
        assert!(
            (centroid - middle * 0.8 * SPEED).abs() < 0.01,
            "{alignment}: {centroid}"
        );
    }
}

#[test]
fn trailing_mirrored_in_time_is_leading() {
    // The object turns and moves, so that time reversed differs from time.
    let mut scene = empty_scene("there");
    let mut motion = drift(DVec3::new(0.0, 0.0, -DISTANCE), SPEED * DVec3::X);
    let turn = spin(DVec3::ZERO, DVec3::Z, 1.5);
    for (key, turned) in motion.keys.iter_mut().zip(&turn.keys) {
        key.orientation = turned.orientation;
        key.turn = turned.turn;
    }
    add(
        &mut scene,
        rectangle(7.0, 2.0),
        glowing(1.0),
        motion.clone(),
    );
    let mut back = scene.clone();
    back.objects[0].motion = mirror_in_time(&motion);
    let trailing = render_truth(&scene, 0.7, Alignment::Trailing);
    let leading = render_truth(&back, 0.7, Alignment::Leading);
    let mut between = coverage_estimates(&trailing, |x, y| {
        f64::from(leading.mean().color.at(x, y)[0])
    });
    for (estimate, error) in between.iter_mut().zip(&leading.standard_error.pixels) {
        estimate.error = estimate.error.hypot(f64::from(error[0]));
    }
    expect_agreement("mirrored", &between, 8);
    let unmirrored = render_truth(&scene, 0.7, Alignment::Leading);
    assert!(spread(&unmirrored).0 > 2.0 && spread(&leading).0 < -2.0);
}

/// Returns the motion whose pose at `t` is the given one's at `-t`; keys at 0 and 1.
fn mirror_in_time(motion: &Motion) -> Motion {
    let [start, end] = [&motion.keys[0], &motion.keys[1]];
    let mut back = motion.clone();
    back.keys[1].translation = 2.0 * start.translation - end.translation;
    back.keys[0].turn.angle = -start.turn.angle;
    back.keys[1].orientation = end.orientation.inverse();
    back
}

#[test]
fn halves_are_independent() {
    let scene = slab_scene(SPEED);
    let truth = render_truth(&scene, 1.0, Alignment::Trailing);
    let ladder =
        trace_ladder(&scene, &render_settings(1.0), &truth, &[256], &unwatched).expect("allowed");
    // The slab's smear is a trapezoid that is equal in every row. The mean over rows gives its exact value, with 1/4 of
    // the noise.
    let errors = |coverage: &frame::Plane| -> Vec<f64> {
        let mut errors = Vec::new();
        for x in 0..WIDTH {
            let column: Vec<f64> = (0..HEIGHT).map(|y| f64::from(*coverage.at(x, y))).collect();
            let mean = column.iter().sum::<f64>() / f64::from(HEIGHT);
            errors.extend(column.iter().map(|value| value - mean));
        }
        errors
    };
    let sets = [
        errors(&truth.halves[0].coverage[1]),
        errors(&truth.halves[1].coverage[1]),
        errors(&ladder.rungs[0].halves[0].coverage[1]),
        errors(&ladder.rungs[0].halves[1].coverage[1]),
    ];
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for a in 0..4 {
        for b in 0..a {
            let both = (product(&sets[a], &sets[a]) * product(&sets[b], &sets[b])).sqrt();
            let correlation = product(&sets[a], &sets[b]) / both;
            // About 400 noisy pixels: the correlation of unrelated numbers has a sigma of 0.05.
            assert!(correlation.abs() < 0.2, "sets {a} and {b}: {correlation}");
        }
    }
}

#[test]
fn offsets_of_replicates_are_halves_and_those_of_their_mean_are_not() {
    let scene = slab_scene(SPEED);
    let settings = render_settings(1.0);
    let tracer = TruthTracer::new(&scene, &settings, &[Alignment::Trailing]).expect("allowed");
    let trace = |index| tracer.trace(index, &unwatched).expect("allowed").remove(0);
    let replicates: Vec<Replicate> = (0..settings.replicates).map(trace).collect();
    for replicate in &replicates {
        let at_instant = &replicate.at_instant;
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
    let settings = render_settings(1.0);
    let truth = trace_truth(&scene, &settings, Alignment::Leading, &unwatched).expect("allowed");
    let subframes = [1, 2, 4, 8];
    let ladder = trace_ladder(&scene, &settings, &truth, &subframes, &unwatched).expect("allowed");
    assert_eq!(ladder.rungs.len(), 4);
    assert!(ladder.provenance.samples_per_pixel >= 64);
    for (rung, subframes) in ladder.rungs.iter().zip(subframes) {
        assert_eq!(rung.subframes, subframes);
        for half in &rung.halves {
            let mut squares = 0.0;
            for x in 0..WIDTH {
                let left = f64::from(x) - 0.5 * f64::from(WIDTH);
                let exact: f64 = (0..subframes)
                    .map(|part| {
                        let time = (f64::from(part) + 0.5) / f64::from(subframes);
                        let slab = SPEED * time - 0.5 * SLAB;
                        ((left + 1.0).min(slab + SLAB) - left.max(slab)).max(0.0)
                    })
                    .sum::<f64>()
                    / f64::from(subframes);
                for y in 0..HEIGHT {
                    squares += (f64::from(*half.coverage[1].at(x, y)) - exact).powi(2);
                }
            }
            let rms = (squares / f64::from(WIDTH * HEIGHT)).sqrt();
            // Still edges at 32 samples and more: 0.02 (prototype), and few pixels are edges.
            assert!(rms < 0.02, "{subframes} sub-frames: rms {rms}");
        }
    }
}

#[test]
fn a_ladder_equals_the_truth_at_still_pixels_and_costs_no_more() {
    let mut scene = slab_scene(2.0);
    // Columns 13.2 to 18.4: the moving slab does not reach the left edge, but reaches the right one.
    let panel = placed(DVec3::new(-8.2, 0.1, -DISTANCE));
    add(&mut scene, rectangle(5.2, 30.0), glowing(0.5), panel);
    let settings = render_settings(1.0);
    let truth = trace_truth(&scene, &settings, Alignment::Trailing, &unwatched).expect("allowed");
    let work = std::sync::atomic::AtomicU64::new(0);
    let ladder = trace_ladder(
        &scene,
        &settings,
        &truth,
        &[1, 2, 4, 8, 16, 32, 64],
        &|progress| {
            work.store(progress.total, std::sync::atomic::Ordering::Relaxed);
            std::ops::ControlFlow::Continue(())
        },
    )
    .expect("allowed");
    let whole = u64::from(WIDTH * HEIGHT * settings.samples_per_pixel);
    assert!(work.into_inner() <= whole);
    let mean = truth.mean();
    for rung in &ladder.rungs {
        for half in &rung.halves {
            let differs = |x: u32| (0..HEIGHT).any(|y| half.color.at(x, y) != mean.color.at(x, y));
            // The slab sweeps 19.25 to 26.75; the margin is 18 / 15 pixels, rounded.
            assert!(differs(18), "the margin is rendered, with its own noise");
            assert!((0..18).chain(28..WIDTH).all(|x| !differs(x)));
        }
    }
}

#[test]
fn the_motion_mask_is_the_coverage_of_objects_that_move_on_screen() {
    let mut scene = slab_scene(SPEED);
    let still = placed(DVec3::new(-15.0, 0.0, -DISTANCE));
    add(&mut scene, rectangle(4.0, 4.0), glowing(1.0), still);
    let dashboard = placed(DVec3::new(15.0, 0.0, -DISTANCE));
    let index = add(&mut scene, rectangle(4.0, 4.0), glowing(1.0), dashboard);
    scene.objects[index].parent = Parent::Camera;
    // Camera still, moving along, turning.
    let expectations = [
        (placed(DVec3::ZERO), [false, true, false, false]),
        (
            drift(DVec3::ZERO, SPEED * DVec3::X),
            [false, false, true, false],
        ),
        (spin(DVec3::ZERO, DVec3::Y, 0.2), [true, true, true, false]),
    ];
    for (camera, moving) in expectations {
        scene.camera.motion = camera;
        let truth = render_truth(&scene, 0.5, Alignment::Centred);
        for (pixel, motion) in truth.motion.pixels.iter().enumerate() {
            let expected: f32 = (0..4)
                .filter(|&object| moving[object])
                .map(|object| truth.mean().coverage[object].pixels[pixel])
                .sum();
            assert!((motion - expected).abs() < 1e-6);
        }
    }
}

#[test]
fn a_frame_holds_the_instant_and_not_the_shutter() {
    let frame = render_frame(&slab_scene(SPEED));
    for x in 0..WIDTH {
        let place = f64::from(x) + 0.5 - 0.5 * f64::from(WIDTH);
        let inside = place.abs() < 0.5 * SLAB;
        for y in 0..HEIGHT {
            assert_eq!(*frame.object_id.at(x, y), u32::from(inside));
            let depth = if inside { DISTANCE as f32 } else { FAR_DEPTH };
            assert!((frame.depth.at(x, y) / depth - 1.0).abs() < 1e-6);
            let velocity = if inside { SPEED } else { 0.0 };
            assert!((f64::from(frame.velocity.at(x, y)[0]) - velocity).abs() < 1e-5);
        }
    }
}
