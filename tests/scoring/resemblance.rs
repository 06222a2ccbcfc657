//! The wrong blur that a picture resembles most.

use frame::Picture;
use judge::{Decoys, make_wrong_pictures};
use metrics::{Reference, scatter_oracle};
use tests::synthetic::{Object, Sampling, Scene, Shape, VIEWING};

use crate::{scene, sliding_disc, smear};

/// Names the wrong blur that each picture resembles, if any.
fn resemblances(scene: &Scene, pictures: &[Picture]) -> Vec<Option<String>> {
    let (frame, truth) = (scene.frame(), scene.truth([Sampling::CLEAN; 2]));
    let reference = Reference::new(&frame, &truth, None, &VIEWING).unwrap();
    let decoys = Decoys::new(&frame, &truth, None, &reference).unwrap();
    let nearest = |picture| {
        let scores = reference.measure(picture).unwrap().scores;
        decoys
            .nearest(&scores, &picture.color)
            .map(|alike| alike.decoy)
    };
    pictures.iter().map(nearest).collect()
}

#[test]
fn a_wrong_blur_resembles_itself_and_the_right_one_none() {
    let scene = sliding_disc();
    let wrong = make_wrong_pictures(&scene.frame(), &scene.truth([Sampling::CLEAN; 2]), None);
    let (names, mut pictures): (Vec<_>, Vec<_>) = wrong.into_iter().unzip();
    assert!(names.len() >= 10, "{names:?}");
    pictures.push(scene.render(&smear(-1.0, 0.0), Sampling::CLEAN));
    let mut found = resemblances(&scene, &pictures);
    assert_eq!(found.pop(), Some(None));
    let names: Vec<Option<String>> = names.into_iter().map(Some).collect();
    assert_eq!(found, names);
}

#[test]
fn mistakes_of_length_direction_and_brightness_are_told_apart() {
    let scene = sliding_disc();
    let (frame, truth) = (scene.frame(), scene.truth([Sampling::CLEAN; 2]));
    let mut bright = scatter_oracle(&frame, truth.shutter, &truth.shutter_profile);
    for pixel in &mut bright.color.pixels {
        *pixel = pixel.map(|value| 1.05 * value);
    }
    for plane in &mut bright.coverage {
        plane.pixels.iter_mut().for_each(|share| *share *= 1.05);
    }
    let mut mirrored = scene.clone();
    mirrored.objects[0].displacement[1] *= -1.0;
    let pictures = [
        scene.render(&smear(-1.9, 0.0), Sampling::CLEAN),
        mirrored.render(&smear(-1.0, 0.0), Sampling::CLEAN),
        bright,
    ];
    let found = resemblances(&scene, &pictures);
    let due = ["twice_length", "y_flipped", "too_bright"];
    assert_eq!(found, due.map(|name| Some(name.to_owned())));
}

#[test]
fn a_flipped_y_is_no_mistake_of_what_moves_sideways() {
    let disc = Object::sliding(Shape::Disc(9.0), [46.3, 26.2], [24.0, 0.0]);
    let scene = scene([72, 48], vec![disc]);
    let (frame, truth) = (scene.frame(), scene.truth([Sampling::CLEAN; 2]));
    let wrong = make_wrong_pictures(&frame, &truth, None).into_iter();
    let mut flipped = wrong.filter(|(name, _)| name == "y_flipped");
    let (_, picture) = flipped.next().unwrap();
    assert_eq!(resemblances(&scene, &[picture]), [None]);
}

/// Scores alone may be like those of another mistake: the pictures tell which.
#[test]
fn a_mistake_is_told_by_the_picture_among_those_with_like_scores() {
    let scene = sliding_disc();
    let (frame, truth) = (scene.frame(), scene.truth([Sampling::CLEAN; 2]));
    let reference = Reference::new(&frame, &truth, None, &VIEWING).unwrap();
    let decoys = Decoys::new(&frame, &truth, None, &reference).unwrap();
    let wrong = make_wrong_pictures(&frame, &truth, None);
    let picture = |name: &str| &wrong.iter().find(|(other, _)| other == name).unwrap().1;
    let scores = reference.measure(picture("half_length")).unwrap().scores;
    let alike = |picture: &Picture| {
        let alike = decoys.nearest(&scores, &picture.color);
        alike.map(|alike| alike.decoy)
    };
    assert_eq!(
        alike(picture("half_length")),
        Some("half_length".to_owned())
    );
    // Nothing with these scores changes the best blur like this picture.
    assert_eq!(alike(picture("one_color")), None);
}
