//! The measured smear of pictures whose smear is known.

use frame::Image;
use metrics::{Smear, measure_smear};
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape};

/// A disc that moves 12 pixels during the exposure.
fn small_disc() -> Scene {
    let disc = Object::sliding(Shape::Disc(9.0), [56.3, 42.2], [12.0, 0.0]);
    crate::scene([112, 84], vec![disc])
}

fn measure(scene: &Scene, picture: &Image) -> Smear {
    measure_smear(&scene.frame(), picture).unwrap()
}

#[test]
fn a_filter_that_changes_nothing_or_rounds_has_a_smear_of_zero_length() {
    let scene = small_disc();
    let sharp = scene.frame().picture().color;
    // Half floats are off by up to 0.0005.
    for rounding in [0.0, 0.0004] {
        let mut is_up = false;
        let rounded = sharp.map(|color| {
            is_up = !is_up;
            let factor = if is_up {
                1.0 + rounding
            } else {
                1.0 - rounding
            };
            color.map(|value| value * factor)
        });
        let smear = measure(&scene, &rounded);
        assert_eq!((smear.length(), smear.weight), (0.0, 0.0), "{rounding}");
        assert_eq!(smear.motion, 12.0);
    }
    let blurred = scene.render(&Blur::TRUE, Sampling::CLEAN).color;
    assert!(measure(&scene, &blurred).length() > 0.5);
}

#[test]
fn a_picture_of_one_colour_shows_no_smear() {
    let mut frame = small_disc().frame();
    frame.color.pixels.fill([0.5; 3]);
    assert_eq!(measure_smear(&frame, &frame.color), None);
}

#[test]
fn without_names_of_objects_all_that_moves_is_one_mover() {
    let scene = small_disc();
    let blurred = scene.render(&Blur::TRUE, Sampling::CLEAN).color;
    let named = measure(&scene, &blurred);
    let mut frame = scene.frame();
    frame.objects.truncate(1);
    frame.object_id.pixels.fill(0);
    assert_eq!(measure_smear(&frame, &blurred), Some(named));
    // Two movers that go different ways have no common smear.
    let other = Object::sliding(Shape::Disc(9.0), [56.3, 15.0], [0.0, 12.0]);
    frame = crate::scene([112, 84], vec![scene.objects[0], other]).frame();
    frame.objects.truncate(1);
    frame.object_id.pixels.fill(0);
    assert_eq!(measure_smear(&frame, &blurred), None);
}
