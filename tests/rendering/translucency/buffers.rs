//! Translucent surfaces in velocity and depth, in what the shutter sees, and in bytes.

use frame::{Alignment, FAR_DEPTH, Truth, VelocityKind};
use glam::{DVec3, Vec3};
use tests::shapes::*;
use tests::unwatched;
use tracer::{
    Background, Material, RenderSettings, Scene, Sun, Translucency, trace_frame, trace_truth,
};

use super::{film, glass};

fn render_settings() -> RenderSettings {
    let mut settings = RenderSettings {
        width: 32,
        height: 18,
        samples_per_pixel: 32,
        ..RenderSettings::default()
    };
    settings.options.velocity = VelocityKind::PreviousFrame;
    settings
}

fn render_truth(scene: &Scene) -> Truth {
    let settings = render_settings();
    trace_truth(scene, &settings, Alignment::Trailing, &unwatched).expect("allowed")
}

/// Makes a still wall, and a pane of this material that moves to the right before it. One metre of the pane is one pixel.
fn pane_scene(pane: Material) -> Scene {
    let mut scene = empty_scene("pane");
    let at = |z: f64| DVec3::new(0.0, 0.0, z);
    add(
        &mut scene,
        rectangle(1000.0, 20.0),
        glowing(0.5),
        placed(at(-20.0)),
    );
    add(
        &mut scene,
        rectangle(6.0, 6.0),
        pane,
        drift(at(-9.0), 4.0 * DVec3::X),
    );
    scene
}

fn half() -> Material {
    film(Vec3::ONE, 0.5, Vec3::ONE)
}

fn written(mut material: Material) -> Material {
    material.translucency = Some(Translucency {
        in_buffers: true,
        ..material.translucency.expect("it is translucent")
    });
    material
}

#[test]
fn velocity_and_depth_are_those_of_what_lies_behind_unless_a_material_says_otherwise() {
    let none = film(Vec3::ZERO, 0.0, Vec3::ONE);
    let cases = [
        (half(), false),
        (written(half()), true),
        (glass(1.5, Vec3::ONE), false),
        (written(glass(1.5, Vec3::ONE)), true),
        // What changes no light is not there.
        (written(none), false),
    ];
    for (pane, is_written) in cases {
        let frame = trace_frame(&pane_scene(pane), &render_settings(), &unwatched).unwrap();
        let found = (
            frame.velocity.at(16, 9)[0],
            *frame.depth.at(16, 9),
            *frame.object_id.at(16, 9),
        );
        let expected = if is_written {
            (4.0, 9.0, 2)
        } else {
            (0.0, 20.0, 1)
        };
        assert!((found.0 - expected.0).abs() < 1e-4, "{found:?}");
        assert_eq!((found.1, found.2), (expected.1, expected.2));
    }
    // Nothing opaque lies behind.
    let mut scene = pane_scene(half());
    scene.objects[0].motion = placed(DVec3::new(0.0, 0.0, 20.0));
    let frame = trace_frame(&scene, &render_settings(), &unwatched).unwrap();
    assert_eq!(*frame.depth.at(16, 9), FAR_DEPTH);
}

#[test]
fn a_film_is_seen_wherever_it_passes_and_hides_nothing() {
    let faint = render_truth(&pane_scene(film(Vec3::ONE, 0.01, Vec3::ONE)));
    let opaque = render_truth(&pane_scene(glowing(1.0)));
    // Rays of the support meet every film, however faint.
    assert_eq!(faint.support.seen[2], opaque.support.seen[2]);
    assert_eq!(faint.support.moving, opaque.support.moving);
    // Where the pane stays before the wall while the shutter is open, a film shows both and an opaque pane itself.
    let seen = |truth: &Truth| [1, 2].map(|object| *truth.support.seen[object].at(14, 9));
    assert_eq!((seen(&faint), seen(&opaque)), ([true, true], [false, true]));
    // The wall is seen behind it at all times, and so is each point of the film at the instant.
    let count = |truth: &Truth| {
        let unknowable = truth.support.unknowable.pixels.iter();
        unknowable.filter(|unknowable| **unknowable).count()
    };
    assert_eq!(count(&faint), 0);
    assert!(count(&opaque) > 10);
    // Coverage follows the opacity: samples of both truths lie elsewhere.
    let sum = |truth: &Truth| truth.mean().coverage[2].pixels.iter().sum::<f32>();
    let ratio = sum(&faint) / sum(&opaque);
    assert!((ratio - 0.01).abs() < 2e-4, "{ratio}");
}

#[test]
fn shading_frozen_at_the_instant_keeps_the_film_before_it() {
    // A lamp comes near the wall from behind the camera while the shutter is open. Between them hangs a film.
    let lit = |filter: Vec3| {
        let mut scene = empty_scene("frozen");
        let at = |x: f64, z: f64| DVec3::new(x, 0.0, z);
        add(
            &mut scene,
            rectangle(30.0, 20.0),
            diffuse(0.8),
            placed(at(0.0, -10.0)),
        );
        let lamp = drift(at(0.0, 3.0), -12.0 * DVec3::Z);
        add(&mut scene, rectangle(4.0, 4.0), glowing(9.0), lamp);
        add(
            &mut scene,
            rectangle(90.0, 90.0),
            film(Vec3::ZERO, 0.0, filter),
            placed(at(0.0, -2.0)),
        );
        let truth = render_truth(&scene);
        let sum = |image: &frame::Image| image.pixels.iter().map(|pixel| pixel[0]).sum::<f32>();
        let halves = truth.at_instant.iter().map(|half| sum(&half.frozen));
        [sum(&truth.mean().color), 0.5 * halves.sum::<f32>()]
    };
    let [clear, halved] = [0.99999, 0.5].map(|share| lit(Vec3::splat(share)));
    for (clear, halved) in clear.into_iter().zip(halved) {
        // Light passes the film twice; noise of 576 pixels.
        assert!((halved / clear - 0.25).abs() < 0.01, "{halved} of {clear}");
    }
    assert!(
        (clear[0] - clear[1]).abs() > 0.1 * clear[0],
        "the lamp's light changes"
    );
}

/// A scene in which everything that is drawn is drawn: films, glass, lamps behind them, sky, sun, bounces, motion.
fn busy_scene() -> Scene {
    let mut scene = pane_scene(glass(1.6, Vec3::new(0.9, 1.0, 0.8)));
    scene.background = Background::Gradient {
        ground: Vec3::splat(0.1),
        horizon: Vec3::new(0.5, 0.6, 0.7),
        zenith: Vec3::new(0.2, 0.3, 0.9),
    };
    scene.sun = Some(Sun {
        direction: DVec3::new(0.6, 0.7, 0.4).normalize(),
        irradiance: Vec3::ONE,
        angular_radius: 0.02,
    });
    scene.materials[0] = diffuse(0.7);
    let smoke = Material {
        diffuse: Vec3::splat(0.8),
        ..film(Vec3::ZERO, 0.4, Vec3::new(0.8, 0.9, 1.0))
    };
    let near = DVec3::new(2.0, 0.0, -6.0);
    add(
        &mut scene,
        icosphere(2.0, 1),
        smoke,
        spin(near, DVec3::Y, 1.0),
    );
    let lamp = film(Vec3::splat(4.0), 0.6, Vec3::ONE);
    add(
        &mut scene,
        cuboid(Vec3::ONE),
        lamp,
        drift(DVec3::new(-3.0, 1.0, -7.0), DVec3::X),
    );
    scene
}

#[test]
fn the_bytes_do_not_depend_on_the_number_of_threads() {
    let scene = busy_scene();
    let render = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads are available").install(|| {
            let frame = trace_frame(&scene, &render_settings(), &unwatched).expect("allowed");
            (frame, render_truth(&scene))
        })
    };
    let (frame, truth) = render(1);
    for threads in [2, 5] {
        let (other_frame, other_truth) = render(threads);
        assert_eq!(frame, other_frame);
        assert_eq!(truth.mean(), other_truth.mean());
        assert_eq!(truth.at_instant, other_truth.at_instant);
        assert_eq!(truth.support, other_truth.support);
    }
}
