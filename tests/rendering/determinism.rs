//! Determinism: equal inputs give equal bytes, and hashes distinguish inputs.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use frame::{Alignment, Efficiency, Frame, Ladder, Picture, Truth, VelocityKind};
use glam::{DVec3, Vec3};
use scene::{Background, Lens, Scene};
use tracer::{
    PixelGrid, Progress, RenderSettings, TraceError, frame_hash, ladder_hash, replicate_hash,
    trace_frame_part, trace_ladder, trace_truth, truth_hash,
};

use crate::lens::with_lens;
use crate::renders::*;
use crate::translucency::{film, glass};

const RUNGS: [u32; 3] = [1, 4, 16];

/// Makes a scene with everything that draws random numbers: sky, sun disc, lamps, bounces, films,
/// glass, motion.
fn busy_scene() -> Scene {
    let mut scene = empty_scene("busy");
    scene.background = Background::Gradient {
        ground: Vec3::splat(0.1),
        horizon: Vec3::new(0.5, 0.6, 0.7),
        zenith: Vec3::new(0.2, 0.3, 0.9),
    };
    scene.sun = sun(DVec3::new(0.6, 0.8, 0.0), 1.0, 0.02);
    let at = |x: f64, z: f64| DVec3::new(x, 0.0, z);
    let mut smoke = film(Vec3::ZERO, 0.4, Vec3::new(0.8, 0.9, 1.0));
    smoke.diffuse = Vec3::splat(0.8);
    let lamp = film(Vec3::splat(4.0), 0.6, Vec3::ONE);
    let tinted = glass(1.6, Vec3::new(0.9, 1.0, 0.8));
    let turning = spin(at(1.0, -4.0), DVec3::Y, 2.0);
    let drifting = drift(at(-1.0, -4.0), DVec3::X);
    for (mesh, material, motion) in [
        (icosphere(1.0, 2), diffuse(0.7), drifting),
        (cuboid(Vec3::ONE), glowing(2.0), turning),
        (rectangle(9.0, 9.0), diffuse(0.5), placed(at(0.0, -5.0))),
        (icosphere(0.5, 1), smoke, spin(at(0.0, -3.0), DVec3::Y, 1.0)),
        (cuboid(Vec3::ONE), lamp, drift(at(-2.0, -3.5), DVec3::X)),
        (rectangle(1.0, 1.0), tinted, drift(at(1.0, -2.0), DVec3::X)),
    ] {
        add(&mut scene, mesh, material, motion);
    }
    scene
}

fn own_settings() -> RenderSettings {
    settings([33, 19], 64)
}

fn everything(scene: &Scene, settings: &RenderSettings) -> (Frame, Truth, Ladder) {
    let frame = render_frame(scene, settings);
    let truth = render_truth(scene, settings, Alignment::Centred);
    let ladder = render_ladder(scene, settings, &truth, &RUNGS);
    (frame, truth, ladder)
}

#[test]
fn what_stands_still_has_the_same_noise_in_frame_and_truth() {
    let traced = |scene: &Scene| {
        let settings = own_settings();
        let grid = PixelGrid::of_picture(settings.width, settings.height);
        let frame = trace_frame_part(scene, &settings, &grid, None, &unwatched).unwrap();
        [Alignment::Trailing, Alignment::Centred]
            .map(|alignment| (frame.clone(), render_truth(scene, &settings, alignment)))
    };
    let mut still = busy_scene();
    for object in &mut still.objects {
        object.motion.keys.truncate(1);
    }
    for (frame, truth) in traced(&still) {
        let halves =
            [0, 1].map(|half| Picture::mean(frame.replicates.iter().skip(half).step_by(2)));
        assert_eq!(halves, truth.halves);
        assert_eq!(frame.frame.samples.as_ref(), Some(&truth.samples));
        assert_ne!(halves[0], halves[1], "the scene is lit and noisy");
    }
    // A mover changes the light on all that it can be seen from.
    for (frame, truth) in traced(&busy_scene()) {
        assert_ne!(frame.frame.picture(), truth.mean());
    }
}

#[test]
fn one_thread_and_several_give_the_same_bytes() {
    let scene = busy_scene();
    let on_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.expect("threads are available");
        pool.install(|| everything(&scene, &own_settings()))
    };
    let alone = on_threads(1);
    // No value is NaN (it would differ from itself), so equality means equal bits except for the
    // sign of zero.
    for threads in [1, 2, 5] {
        assert_eq!(alone, on_threads(threads));
    }
}

#[test]
fn another_seed_gives_other_noise() {
    let scene = busy_scene();
    let mut other = own_settings();
    other.seed = 2;
    let [a, b] = [own_settings(), other].map(|settings| everything(&scene, &settings));
    assert_ne!(a.1.halves, b.1.halves);
    assert_ne!(a.1.halves[0], a.1.halves[1]);
    assert_ne!(a.2.rungs[2].groups, b.2.rungs[2].groups);
}

/// Returns the settings of a frame of one replicate, as `trace_frame` renders it.
fn of_one_replicate(settings: &RenderSettings) -> RenderSettings {
    RenderSettings {
        replicates: 1,
        ..*settings
    }
}

/// Returns the hashes of a scene's frame, truth, replicates and ladder.
fn hashes(scene: &Scene, settings: &RenderSettings) -> [String; 4] {
    let centred = Alignment::Centred;
    [
        frame_hash(scene, &of_one_replicate(settings)),
        truth_hash(scene, settings, centred),
        replicate_hash(scene, settings, centred),
        ladder_hash(scene, settings, centred, &RUNGS),
    ]
}

#[test]
fn pictures_bear_the_hashes_of_their_inputs() {
    let (scene, settings) = (busy_scene(), own_settings());
    let (frame, truth, ladder) = everything(&scene, &settings);
    let provenances = [frame.provenance, truth.provenance, ladder.provenance];
    let [frame, truth, _, ladder] = hashes(&scene, &settings);
    assert_eq!(
        provenances.map(|provenance| provenance.content_hash),
        [frame, truth, ladder]
    );
}

#[test]
fn hashes_change_with_everything_that_changes_pixels() {
    let (scene, settings) = (busy_scene(), own_settings());
    let leading = truth_hash(&scene, &settings, Alignment::Leading);
    let of_ladder = ladder_hash(&scene, &settings, Alignment::Centred, &[1, 4]);
    let mut all = vec![leading, of_ladder];
    all.extend(hashes(&scene, &settings));
    let changes: [fn(&mut RenderSettings); 4] = [
        |settings| settings.width = 34,
        |settings| settings.exposure = Some(0.25),
        |settings| settings.samples_per_pixel = 128,
        |settings| settings.seed = 7,
    ];
    for change in changes {
        let mut settings = settings;
        change(&mut settings);
        all.extend(hashes(&scene, &settings));
    }
    let four = settings.with_replicates(4);
    all.push(truth_hash(&scene, &four, Alignment::Centred));
    let lens = |aperture, focus| Some(Lens { aperture, focus });
    let changes: [&dyn Fn(&mut Scene); 6] = [
        &|scene| scene.hash = "other".into(),
        &|scene| scene.camera.lens = lens(0.3, 3.0),
        &|scene| scene.camera.lens = lens(0.31, 3.0),
        &|scene| scene.camera.lens = lens(0.3, 3.1),
        &|scene| scene.shutter_profile.rolling = 0.1,
        &|scene| scene.shutter_profile.efficiency = Efficiency::Table(vec![1.0, 1.0]),
    ];
    for change in changes {
        let mut scene = scene.clone();
        change(&mut scene);
        all.extend(hashes(&scene, &settings));
    }
    let count = all.len();
    all.sort();
    all.dedup();
    assert_eq!(all.len(), count, "two different renders have the same hash");
}

#[test]
fn hashes_leave_out_what_changes_no_pixel() {
    let (scene, settings) = (busy_scene(), own_settings());
    let mut named = settings;
    named.exposure = Some(scene.exposure);
    let mut of_frame = named;
    of_frame.options.velocity = VelocityKind::PreviousFrame;
    of_frame.guard_band = 3;
    let expected = hashes(&scene, &settings);
    assert_eq!(expected[1..], hashes(&scene, &of_frame)[1..]);
    assert_ne!(
        expected[0],
        frame_hash(&scene, &of_one_replicate(&of_frame))
    );
    assert_eq!(expected[0], frame_hash(&scene, &of_one_replicate(&named)));
    assert_ne!(expected[0], frame_hash(&scene, &named));
    let lens = with_lens(scene, 0.3, 3.0);
    assert_eq!(expected, hashes(&lens.pinhole(), &settings));
}

#[test]
fn progress_rises_to_the_whole_and_break_cancels() {
    let (scene, settings) = (busy_scene(), own_settings());
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
    let cancelled = trace_truth(&scene, &settings, Alignment::Centred, &stop);
    assert_eq!(cancelled, Err(TraceError::Cancelled));
    assert!(calls.into_inner() < 20, "work went on after the break");
}

type Change = fn(&mut RenderSettings);

/// Changes of settings, and the end of the message.
const BAD_SETTINGS: [(Change, &str); 6] = [
    (
        |settings| settings.samples_per_pixel = 100,
        "is 100 over 8 replicates; allowed: 8 times a number up to 65536, such as 96",
    ),
    (
        |settings| settings.samples_per_pixel = 4,
        "is 4 over 8 replicates; allowed: 8 times a number up to 65536, such as 8",
    ),
    (
        |settings| settings.replicates = 3,
        "replicates is 3; allowed: even numbers from 2, such as 8",
    ),
    (
        |settings| settings.replicates = 0,
        "replicates is 0; allowed: even numbers from 2, such as 8",
    ),
    (
        |settings| settings.height = 0,
        "size is 33x0; allowed: 1 to 16384 pixels on either side, 67108864 in all",
    ),
    (
        |settings| settings.exposure = Some(-0.5),
        "exposure is -0.5 frames; allowed: above 0 and finite (0.5 frames = 180 degrees)",
    ),
];

#[test]
fn bad_settings_are_refused_with_the_allowed_values() {
    let scene = busy_scene();
    let settings = own_settings();
    let refusal = |scene: &Scene, settings: RenderSettings, alignment: Alignment| {
        let refused = trace_truth(scene, &settings, alignment, &unwatched);
        refused.expect_err("refused").to_string()
    };
    for (change, expected) in BAD_SETTINGS {
        let mut settings = settings;
        change(&mut settings);
        let refused = refusal(&scene, settings, Alignment::Centred);
        assert!(refused.ends_with(expected), "{refused}");
    }
    let mut zoom = scene.clone();
    zoom.camera.vertical_fov = vec![(0.0, 1.0), (0.1, 2.0)];
    zoom.exposure = 0.5;
    let refused = refusal(&zoom, settings, Alignment::Leading);
    let expected = "scene busy: the camera's vertical field of view is 343.775";
    assert!(refused.contains(expected), "{refused}");
    let truth = render_truth(&scene, &settings, Alignment::Centred);
    for subframes in [vec![], vec![0, 1], vec![4, 2], vec![2, 2]] {
        let refused = trace_ladder(&scene, &settings, &truth, &subframes, &unwatched);
        assert_eq!(refused, Err(TraceError::Subframes(subframes)));
    }
}
