//! Translucent surfaces in velocity and depth, in the shutter's view, and in bytes.

use frame::{Alignment, FAR_DEPTH, Frame, Truth, VelocityKind};
use glam::{DVec3, Vec3};
use scene::{Material, Scene, Translucency};

use super::{film, glass};
use crate::renders::{self, *};

fn render_frame(scene: &Scene) -> Frame {
    let settings = renders::settings_with([32, 18], 32, VelocityKind::PreviousFrame);
    renders::render_frame(scene, &settings)
}

fn render_truth(scene: &Scene) -> Truth {
    renders::render_truth(scene, &renders::settings([32, 18], 32), Alignment::Trailing)
}

/// Makes a still wall, and a pane of this material that moves to the right in front of it. One
/// metre of the pane is one pixel.
fn pane_scene(pane: Material) -> Scene {
    let mut scene = empty_scene("pane");
    let wall = placed(DVec3::new(0.0, 0.0, -20.0));
    add(&mut scene, rectangle(1000.0, 20.0), glowing(0.5), wall);
    let moving = drift(DVec3::new(0.0, 0.0, -9.0), 4.0 * DVec3::X);
    add(&mut scene, rectangle(6.0, 6.0), pane, moving);
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
        // A surface that changes no light is absent.
        (written(none), false),
    ];
    for (pane, is_written) in cases {
        let frame = render_frame(&pane_scene(pane));
        let velocity = frame.velocity.at(16, 9)[0];
        let actual = (*frame.depth.at(16, 9), *frame.object_id.at(16, 9));
        let due = [((20.0, 1), 0.0), ((9.0, 2), 4.0)];
        let (expected, speed) = due[usize::from(is_written)];
        assert!((velocity - speed).abs() < 1e-4, "{velocity}");
        assert_eq!(actual, expected);
    }
    // Nothing opaque is behind.
    let mut scene = pane_scene(half());
    scene.objects[0].motion = placed(DVec3::new(0.0, 0.0, 20.0));
    assert_eq!(*render_frame(&scene).depth.at(16, 9), FAR_DEPTH);
}

#[test]
fn a_film_is_seen_wherever_it_passes_and_hides_nothing() {
    let faint = render_truth(&pane_scene(film(Vec3::ONE, 0.01, Vec3::ONE)));
    let opaque = render_truth(&pane_scene(glowing(1.0)));
    // Rays of the support hit every film, however faint.
    assert_eq!(faint.support.seen[2], opaque.support.seen[2]);
    assert_eq!(faint.support.moving, opaque.support.moving);
    // If the pane stays in front of the wall while the shutter is open, a film shows both and an
    // opaque pane itself.
    let seen = |truth: &Truth| [1, 2].map(|object| *truth.support.seen[object].at(14, 9));
    assert_eq!((seen(&faint), seen(&opaque)), ([true, true], [false, true]));
    // The wall is visible behind it at all times, and so is each point of the film at the instant.
    let count = |truth: &Truth| {
        let unknowable = truth.support.unknowable.pixels.iter();
        unknowable.filter(|unknowable| **unknowable).count()
    };
    assert_eq!(count(&faint), 0);
    assert!(count(&opaque) > 10);
    // Coverage follows the opacity: samples of both truths are at different positions.
    let sum = |truth: &Truth| truth.mean().coverage[2].pixels.iter().sum::<f32>();
    let ratio = sum(&faint) / sum(&opaque);
    assert!((ratio - 0.01).abs() < 2e-4, "{ratio}");
}

#[test]
fn shading_frozen_at_the_instant_keeps_the_film_before_it() {
    // A lamp comes near the wall from behind the camera while the shutter is open. Between them
    // hangs a film.
    let lit = |filter: Vec3| {
        let mut scene = empty_scene("frozen");
        let at = |z: f64| DVec3::new(0.0, 0.0, z);
        zoom_slightly(&mut scene);
        let lamp = drift(at(3.0), -12.0 * DVec3::Z);
        let wall = placed(at(-10.0));
        add(&mut scene, rectangle(30.0, 20.0), diffuse(0.8), wall);
        add(&mut scene, rectangle(4.0, 4.0), glowing(9.0), lamp);
        let clear = film(Vec3::ZERO, 0.0, filter);
        add(&mut scene, rectangle(90.0, 90.0), clear, placed(at(-2.0)));
        let truth = render_truth(&scene);
        let sum = |image: &frame::Image| image.pixels.iter().map(|pixel| pixel[0]).sum::<f32>();
        [sum(&truth.mean().color), sum(&truth.frozen_mean())]
    };
    let [clear, halved] = [0.99999, 0.5].map(|share| lit(Vec3::splat(share)));
    for (clear, halved) in clear.into_iter().zip(halved) {
        // Light passes the film twice; noise of 576 pixels.
        assert!((halved / clear - 0.25).abs() < 0.01, "{halved} of {clear}");
    }
    let [live, frozen] = clear;
    assert!((live - frozen).abs() > 0.1 * live, "{live} {frozen}");
}
