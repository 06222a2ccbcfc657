//! Determinism: equal inputs give equal bytes.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use frame::{Alignment, Frame, FrameOptions, Ladder, Truth, VelocityKind};
use glam::{DVec3, Vec3};
use tests::shapes::*;
use tests::unwatched;
use tracer::{
    Background, Progress, RenderSettings, Scene, Sun, TraceError, frame_hash, ladder_hash,
    trace_frame, trace_ladder, trace_truth, truth_hash,
};

/// Makes a scene with everything that draws random numbers: sky, sun disc, lamp, bounces, motion.
fn busy_scene() -> Scene {
    let mut scene = empty_scene("busy");
    scene.background = Background::Gradient {
        ground: Vec3::splat(0.1),
        horizon: Vec3::new(0.5, 0.6, 0.7),
        zenith: Vec3::new(0.2, 0.3, 0.9),
    };
    scene.sun = Some(Sun {
        direction: DVec3::new(0.6, 0.8, 0.0),
        irradiance: Vec3::ONE,
        angular_radius: 0.02,
    });
    let at = |x: f64| DVec3::new(x, 0.0, -4.0);
    add(
        &mut scene,
        icosphere(1.0, 2),
        diffuse(0.7),
        drift(at(-1.0), DVec3::X),
    );
    add(
        &mut scene,
        cuboid(Vec3::ONE),
        glowing(2.0),
        spin(at(1.0), DVec3::Y, 2.0),
    );
    add(
        &mut scene,
        rectangle(9.0, 9.0),
        diffuse(0.5),
        placed(at(0.0) - DVec3::Z),
    );
    scene
}

fn render_settings() -> RenderSettings {
    RenderSettings {
        width: 33,
        height: 19,
        samples_per_pixel: 64,
        ..RenderSettings::default()
    }
}

fn everything(scene: &Scene, settings: &RenderSettings) -> (Frame, Truth, Ladder) {
    let frame = trace_frame(scene, settings, &unwatched).expect("allowed");
    let truth = trace_truth(scene, settings, Alignment::Centred, &unwatched).expect("allowed");
    let ladder = trace_ladder(scene, settings, &truth, &[1, 4, 16], &unwatched).expect("allowed");
    (frame, truth, ladder)
}

fn on_threads(threads: usize) -> (Frame, Truth, Ladder) {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads are available")
        .install(|| everything(&busy_scene(), &render_settings()))
}

#[test]
fn frame_and_truth_do_not_share_their_noise() {
    let mut scene = busy_scene();
    for object in &mut scene.objects {
        object.motion.keys.truncate(1);
    }
    // Nothing moves: with shared numbers the frame would equal the truth's first replicate, pixel by pixel.
    let settings = RenderSettings {
        samples_per_pixel: 32,
        replicates: 2,
        ..render_settings()
    };
    let frame = trace_frame(&scene, &settings.with_replicates(1), &unwatched).expect("allowed");
    let truth = trace_truth(&scene, &settings, Alignment::Centred, &unwatched).expect("allowed");
    for half in &truth.halves {
        let pairs = frame.color.pixels.iter().zip(&half.color.pixels);
        let equal = pairs.filter(|(a, b)| a == b).count();
        // Only pixels of the even lamp are naturally equal; the rest is lit and noisy.
        assert!(
            equal * 2 < frame.color.pixels.len(),
            "{equal} pixels are equal"
        );
    }
}

#[test]
fn one_thread_and_several_give_the_same_bytes() {
    let alone = on_threads(1);
    // No value is NaN (it would differ from itself), so equality means equal bits except for the sign of zero.
    assert_eq!(alone, on_threads(1));
    assert_eq!(alone, on_threads(2));
    assert_eq!(alone, on_threads(5));
}

#[test]
fn another_seed_gives_other_noise() {
    let scene = busy_scene();
    let other = RenderSettings {
        seed: 2,
        ..render_settings()
    };
    let [a, b] = [render_settings(), other].map(|settings| everything(&scene, &settings));
    assert_ne!(a.1.halves, b.1.halves);
    assert_ne!(a.1.halves[0], a.1.halves[1]);
    assert_ne!(a.2.rungs[2].halves, b.2.rungs[2].halves);
}

#[test]
fn hashes_change_with_everything_that_changes_pixels() {
    let scene = busy_scene();
    let settings = render_settings();
    let (frame, truth, ladder) = everything(&scene, &settings);
    assert_eq!(frame.provenance.content_hash, frame_hash(&scene, &settings));
    assert_eq!(
        truth.provenance.content_hash,
        truth_hash(&scene, &settings, Alignment::Centred)
    );
    assert_eq!(
        ladder.provenance.content_hash,
        ladder_hash(&scene, &settings, Alignment::Centred, &[1, 4, 16])
    );
    let hash = |settings: RenderSettings| truth_hash(&scene, &settings, Alignment::Centred);
    let mut hashes = vec![
        hash(settings),
        truth_hash(&scene, &settings, Alignment::Leading),
        hash(RenderSettings {
            width: 34,
            ..settings
        }),
        hash(RenderSettings {
            exposure: Some(0.25),
            ..settings
        }),
        hash(RenderSettings {
            samples_per_pixel: 128,
            ..settings
        }),
        hash(RenderSettings {
            replicates: 4,
            ..settings
        }),
        hash(RenderSettings {
            seed: 7,
            ..settings
        }),
        truth_hash(
            &Scene {
                hash: "other".into(),
                ..scene.clone()
            },
            &settings,
            Alignment::Centred,
        ),
        ladder_hash(&scene, &settings, Alignment::Centred, &[1, 4]),
        ladder_hash(&scene, &settings, Alignment::Centred, &[1, 4, 16]),
        frame_hash(&scene, &settings),
    ];
    let count = hashes.len();
    hashes.sort();
    hashes.dedup();
    assert_eq!(
        hashes.len(),
        count,
        "two different renders have the same hash"
    );
}

#[test]
fn hashes_leave_out_what_changes_no_pixel() {
    let scene = busy_scene();
    let settings = render_settings();
    let named = RenderSettings {
        exposure: Some(scene.exposure),
        ..settings
    };
    let of_frame = RenderSettings {
        options: FrameOptions {
            velocity: VelocityKind::PreviousFrame,
            ..settings.options
        },
        guard_band: 3,
        ..named
    };
    let hash = |settings| truth_hash(&scene, settings, Alignment::Centred);
    assert_eq!(hash(&settings), hash(&of_frame));
    let of_truth = RenderSettings {
        replicates: 2,
        ..named
    };
    assert_eq!(frame_hash(&scene, &settings), frame_hash(&scene, &of_truth));
    assert_ne!(frame_hash(&scene, &settings), frame_hash(&scene, &of_frame));
}

#[test]
fn progress_rises_to_the_whole_and_break_cancels() {
    let scene = busy_scene();
    let settings = render_settings();
    let greatest = AtomicU64::new(0);
    let total = AtomicU64::new(0);
    let watch = |progress: Progress| {
        assert!(progress.done <= progress.total);
        total.store(progress.total, Ordering::Relaxed);
        greatest.fetch_max(progress.done, Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    let truth = trace_truth(&scene, &settings, Alignment::Centred, &watch).expect("allowed");
    let samples: f32 = truth.samples.pixels.iter().sum();
    assert_eq!(total.into_inner(), samples as u64);
    assert_eq!(greatest.into_inner(), samples as u64);
    let calls = AtomicU64::new(0);
    let stop = |_: Progress| {
        calls.fetch_add(1, Ordering::Relaxed);
        ControlFlow::Break(())
    };
    assert_eq!(
        trace_truth(&scene, &settings, Alignment::Centred, &stop),
        Err(TraceError::Cancelled)
    );
    assert!(calls.into_inner() < 20, "work went on after the break");
}

#[test]
fn bad_settings_are_refused_with_the_allowed_values() {
    let scene = busy_scene();
    let message = |settings: RenderSettings| {
        trace_truth(&scene, &settings, Alignment::Centred, &unwatched)
            .expect_err("refused")
            .to_string()
    };
    let settings = render_settings();
    for (found, expected) in [
        (
            message(RenderSettings {
                samples_per_pixel: 100,
                ..settings
            }),
            "samples per pixel is 100 over 8 replicates; allowed: 8 times a power of two up to 65536, such as 128",
        ),
        (
            message(RenderSettings {
                samples_per_pixel: 4,
                ..settings
            }),
            "samples per pixel is 4 over 8 replicates; allowed: 8 times a power of two up to 65536, such as 8",
        ),
        (
            message(RenderSettings {
                replicates: 3,
                ..settings
            }),
            "replicates is 3; allowed: even numbers from 2, such as 8",
        ),
        (
            message(RenderSettings {
                replicates: 0,
                ..settings
            }),
            "replicates is 0; allowed: even numbers from 2, such as 8",
        ),
        (
            message(RenderSettings {
                height: 0,
                ..settings
            }),
            "size is 33x0; allowed: 1 to 16384 pixels on either side, 67108864 in all",
        ),
        (
            message(RenderSettings {
                exposure: Some(-0.5),
                ..settings
            }),
            "exposure is -0.5 frames; allowed: above 0 and finite (0.5 frames = 180 degrees)",
        ),
    ] {
        assert_eq!(found, expected);
    }
    let mut zoom = busy_scene();
    zoom.camera.vertical_fov = vec![(0.0, 1.0), (0.1, 2.0)];
    let wide = RenderSettings {
        exposure: Some(0.5),
        ..settings
    };
    let refused =
        trace_truth(&zoom, &wide, Alignment::Leading, &unwatched).expect_err("beyond 180 degrees");
    assert!(
        refused
            .to_string()
            .contains("scene busy: the camera's vertical field of view is 343.775")
    );
    let truth = trace_truth(&scene, &settings, Alignment::Centred, &unwatched).expect("allowed");
    for subframes in [vec![], vec![0, 1], vec![4, 2], vec![2, 2]] {
        let refused = trace_ladder(&scene, &settings, &truth, &subframes, &unwatched);
        assert_eq!(refused, Err(TraceError::Subframes(subframes)));
    }
}
