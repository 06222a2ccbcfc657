//! The pass of depth of field on pictures of a pinhole, against the defocused instant that is traced.

use frame::{Frame, Raster};
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
    let pass = trace_pass(scene).apply(&pinhole);
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

#[test]
fn at_edges_the_pass_lacks_only_what_the_pinhole_hides() {
    // A near ball out of focus before a wall with spots in focus.
    let mut scene = spotted_wall();
    let place = placed(DVec3::new(0.5, 0.0, -4.0));
    add(&mut scene, icosphere(1.5, 3), glowing(0.6), place);
    let scene = with_lens(scene, 1.0, DISTANCE);
    let [lens, pass, pinhole] = render(&scene);
    let [own, without] = [&pass, &pinhole].map(|picture| difference(picture, &lens));
    // Measured 0.02 against 0.06: the rim of the ball shows a wall that the pinhole does not.
    assert!(own < 0.5 * without, "{own} {without}");
    // No picture gets lighter or darker: weights sum to 1.
    let flat = Raster::filled(WIDTH, HEIGHT, [0.7f32]);
    for pixel in trace_pass(&scene).apply(&flat).pixels {
        assert!((pixel[0] - 0.7).abs() < 1e-6);
    }
    let plane = flat.map(|pixel| pixel[0]);
    assert_eq!(
        trace_pass(&scene).apply_to_plane(&plane).pixels.len(),
        plane.pixels.len()
    );
}

#[test]
fn the_rim_that_only_the_lens_sees_is_not_read() {
    // The ball hides a bright strip from the centre of the lens, and the pass must not read the ball's own colour for it.
    let mut scene = empty_scene("strip");
    let wall = placed(DVec3::new(0.0, 0.0, -DISTANCE));
    add(&mut scene, rectangle(400.0, 400.0), glowing(0.0), wall);
    let screen = placed(DVec3::new(0.0, 0.0, -4.0));
    add(&mut scene, rectangle(2.4, 400.0), glowing(1.0), screen);
    let scene = with_lens(scene, 1.0, DISTANCE);
    let [lens, pass, _] = render(&scene);
    // Beside the screen's edge, which lies 4 pixels from the middle, both the lens and the pass see the wall through the rim.
    for column in 0..WIDTH {
        let [lens, pass] = [&lens, &pass].map(|picture| picture.at(column, HEIGHT / 2)[0]);
        let from_edge = (f64::from(column) + 0.5 - 24.0).abs() - 4.05;
        if from_edge > 0.5 {
            // The rays that meet the wall here read it where the pinhole shows it.
            assert!((lens - pass).abs() < 0.12, "column {column}: {lens} {pass}");
        }
    }
}

#[test]
fn a_pass_can_be_cancelled_and_is_the_same_every_time() {
    let scene = with_lens(spotted_wall(), 5.0, 0.5 * DISTANCE);
    let cancelled = trace_defocus(&scene, &settings(), &|_| std::ops::ControlFlow::Break(()));
    assert_eq!(cancelled.err(), Some(TraceError::Cancelled));
    let picture = Raster::from_fn(WIDTH, HEIGHT, |x, y| [(x * y) as f32]);
    let [a, b] = [trace_pass(&scene), trace_pass(&scene)].map(|pass| pass.apply(&picture));
    assert_eq!(a, b);
}
