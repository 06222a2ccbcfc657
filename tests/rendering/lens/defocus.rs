//! The pass of depth of field on pictures of a pinhole, against the defocused instant that is traced.

use frame::{Frame, Picture, Raster};
use glam::DVec3;
use tests::shapes::*;
use tests::unwatched;
use tracer::{Defocus, RenderSettings, Scene, TraceError, trace_defocus, trace_frame};

use super::with_lens;

const WIDTH: u32 = 48;
const HEIGHT: u32 = 27;
/// Distance at which a metre is a pixel, at a vertical field of view of 90 degrees.
const DISTANCE: f64 = 0.5 * HEIGHT as f64;

fn settings() -> RenderSettings {
    RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        samples_per_pixel: 1024,
        ..RenderSettings::default()
    }
}

fn trace_pass(scene: &Scene) -> Defocus {
    trace_defocus(scene, &settings(), &unwatched).unwrap()
}

/// Renders the frame of a scene, and what the pass makes of the frame of its pinhole; with the frame of the pinhole.
fn render(scene: &Scene) -> [Raster<[f32; 3]>; 3] {
    let frame = |scene: &Scene| -> Frame { trace_frame(scene, &settings(), &unwatched).unwrap() };
    let pinhole = frame(&scene.clone().pinhole()).color;
    let pass = trace_pass(scene).apply_to_color(&pinhole);
    [frame(scene).color, pass, pinhole]
}

/// Returns the root of the mean squared difference of two pictures.
fn difference(a: &Raster<[f32; 3]>, b: &Raster<[f32; 3]>) -> f64 {
    let squares = (a.pixels.iter().zip(&b.pixels)).map(|(a, b)| f64::from(a[0] - b[0]).powi(2));
    (squares.sum::<f64>() / a.pixels.len() as f64).sqrt()
}

/// Makes an unlit wall with discs on it, at one distance.
fn spotted_wall() -> Scene {
    let mut scene = empty_scene("spots");
    let wall = placed(DVec3::new(0.0, 0.0, -DISTANCE));
    add(&mut scene, rectangle(400.0, 400.0), glowing(0.2), wall);
    for (x, y) in [(-9.0, 3.0), (2.0, -4.0), (11.0, 6.0)] {
        let spot = placed(DVec3::new(x, y, -DISTANCE + 1e-3));
        add(&mut scene, disc(3.0, 64), glowing(1.0), spot);
    }
    scene
}

#[test]
fn where_the_pinhole_shows_everything_the_pass_is_the_lens() {
    let scene = with_lens(spotted_wall(), 5.0, 0.5 * DISTANCE);
    let [lens, pass, pinhole] = render(&scene);
    let [own, without] = [&pass, &pinhole].map(|picture| difference(picture, &lens));
    // 256 rays of a circle of 20 pixels, and the pixels' own width once more: measured 0.008, against 0.16.
    assert!(own < 0.02 && without > 5.0 * own, "{own} {without}");
    // What the pass keeps of light, but for what leaves the picture on one side and comes back on the other.
    let mean = |picture: &Raster<[f32; 3]>| {
        let sum: f64 = picture.pixels.iter().map(|pixel| f64::from(pixel[0])).sum();
        sum / picture.pixels.len() as f64
    };
    assert!((mean(&pass) / mean(&lens) - 1.0).abs() < 0.02);
}

#[test]
fn what_is_in_focus_and_what_has_no_lens_stays_as_it_is() {
    let [lens, pass, pinhole] = render(&with_lens(spotted_wall(), 5.0, DISTANCE));
    assert!(difference(&lens, &pinhole) < 1e-3);
    // The discs lie a millimetre in front of the focus: a ray in some thousands reads the next pixel.
    assert!(difference(&pass, &pinhole) < 1e-3);
    let [_, pass, pinhole] = render(&spotted_wall());
    assert_eq!(pass, pinhole);
}

/// Makes a near ball, out of focus, before the wall, in focus.
fn ball_before_wall() -> Scene {
    let mut scene = spotted_wall();
    let place = placed(DVec3::new(0.5, 0.0, -4.0));
    add(&mut scene, icosphere(1.5, 3), glowing(0.6), place);
    with_lens(scene, 3.0, DISTANCE)
}

#[test]
fn what_the_pinhole_hides_behind_an_edge_is_traced() {
    let [lens, pass, pinhole] = render(&ball_before_wall());
    let [own, without] = [&pass, &pinhole].map(|picture| difference(picture, &lens));
    // A pass that leaves out what the ball hides of the wall makes the ball's rim too dense: 0.7 of the pinhole's difference.
    println!("{own} {without}");
    assert!(own < 0.3 * without, "{own} {without}");
}

#[test]
fn colour_comes_from_the_picture_and_coverage_sums_to_one() {
    let scene = ball_before_wall();
    let frame = trace_frame(&scene.clone().pinhole(), &settings(), &unwatched).unwrap();
    let pass = trace_pass(&scene);
    let picture = pass.apply(&Picture {
        color: frame.color.clone(),
        coverage: frame.coverage.clone(),
    });
    assert_eq!(picture.coverage.len(), scene.objects.len() + 1);
    for pixel in 0..picture.color.pixels.len() {
        let sum: f32 = picture
            .coverage
            .iter()
            .map(|plane| plane.pixels[pixel])
            .sum();
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
    }
    // Far from the ball everything is read: a picture twice as bright comes out twice as bright.
    let bright = frame.color.map(|color| color.map(|value| 2.0 * value));
    let bright = pass.apply_to_color(&bright);
    let corner = [picture.color.at(1, 1)[0], bright.at(1, 1)[0]];
    assert!((corner[1] - 2.0 * corner[0]).abs() < 1e-5, "{corner:?}");
}

#[test]
fn a_pass_can_be_cancelled_and_is_the_same_every_time() {
    let scene = with_lens(spotted_wall(), 5.0, 0.5 * DISTANCE);
    let cancelled = trace_defocus(&scene, &settings(), &|_| std::ops::ControlFlow::Break(()));
    assert_eq!(cancelled.err(), Some(TraceError::Cancelled));
    let picture = Raster::from_fn(WIDTH, HEIGHT, |x, y| [(x * y) as f32; 3]);
    let [a, b] = [0, 1].map(|_| trace_pass(&scene).apply_to_color(&picture));
    assert_eq!(a, b);
}
