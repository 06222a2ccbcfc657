//! Traced scenes with wheels, small movers and hidden parts, and pictures with mistakes in these.
//! Labels are right in all of them, so that colour alone must give a mistake away.

use std::path::Path;

use frame::{Alignment, Frame, Image, Picture, Plane, Raster, Truth, regions};
use measure::{Monitor, Rendering};
use scene::load_scene;
use tests::settings;

use super::decoys::blur_isotropically;
use super::touches::touch;

/// Standard deviation of the blur of a good guess, in pixels.
const GUESS: f64 = 1.0;
/// Standard deviation of the blur of the surroundings that replace an erased object, in pixels.
const FILLED: f64 = 8.0;

/// A scene with the objects that mistakes are made of; none if it has no such object.
pub struct TracedScene {
    pub name: &'static str,
    /// Beginning of the names of its wheels.
    wheels: Option<&'static str>,
    /// A small mover.
    aeroplane: Option<&'static str>,
    /// A large mover.
    car: Option<&'static str>,
}

/// Lists the scenes: in `fan` the blades turn, riders, a sphere and a head are small movers, and a
/// lorry and a torso are large.
pub const SCENES: [TracedScene; 6] = [
    scene("railing", Some("wheel"), Some("aeroplane"), Some("car")),
    scene("wheel_roll", Some("wheel"), None, None),
    scene("fan", Some("fan"), None, None),
    scene("crossing", None, Some("rider_left"), Some("lorry")),
    scene("two_spheres", None, Some("white"), Some("white")),
    scene("walker", None, Some("head"), Some("torso")),
];

const fn scene(
    name: &'static str,
    wheels: Option<&'static str>,
    aeroplane: Option<&'static str>,
    car: Option<&'static str>,
) -> TracedScene {
    TracedScene {
        name,
        wheels,
        aeroplane,
        car,
    }
}

impl TracedScene {
    /// Renders the frame and the truth, or reads those that the tests of the shipped bounds keep.
    pub fn render(&self) -> (Frame, Truth) {
        let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("truths/160x90_256/seed_1");
        let scene = load_scene(tests::scenes().join(self.name), None).unwrap();
        let rendering = Rendering {
            scene: (&scene).into(),
            settings: settings([160, 90], 256),
            out: &out,
            monitor: Monitor::SILENT,
        };
        let frame = rendering.frame().unwrap();
        (frame, rendering.truth(Alignment::Trailing).unwrap())
    }

    /// Makes the right picture, a good guess, and wrong pictures, with their names.
    pub fn decoys(&self, frame: &Frame, truth: &Truth) -> Vec<(&'static str, Picture)> {
        let right = &right_picture(frame, truth);
        let mut decoys = vec![
            ("truth", right.clone()),
            ("hidden part guessed well", guess_well(right, truth)),
            ("hidden part guessed badly", guess_badly(right, truth)),
        ];
        // The truth's own noise hides grain in moving parts of the truth itself.
        let touched = touch(right, &regions(truth).still).into_iter();
        decoys.extend(touched.filter(|(name, _)| !name.ends_with("moving part")));
        if let Some(wheels) = self.wheels {
            decoys.push(("wheels left sharp", sharpen(right, frame, wheels)));
        }
        if let Some(aeroplane) = self.aeroplane {
            decoys.push(("aeroplane erased", erase(right, frame, aeroplane)));
        }
        if let Some(car) = self.car {
            decoys.push(("sharp car over its smear", sharpen(right, frame, car)));
        }
        decoys
    }
}

/// Makes the picture of a perfect filter: the truth where anything moves, and else the frame
/// itself.
fn right_picture(frame: &Frame, truth: &Truth) -> Picture {
    let still = regions(truth).still.map(|still| f32::from(*still));
    let mean = truth.mean();
    Picture {
        color: mix_by(&mean.color, &frame.color, &still),
        ..mean
    }
}

/// Draws the objects with such names, as they are at the instant, over a picture.
fn sharpen(right: &Picture, frame: &Frame, names: &str) -> Picture {
    let objects = frame.objects.iter().zip(&frame.coverage);
    let sharp = objects.filter(|(name, _)| name.starts_with(names));
    let nothing: Plane = frame.coverage[0].map(|_| 0.0);
    let core = sharp.fold(nothing, |sum, (_, matte)| sum.zip(matte, |a, b| a + b));
    Picture {
        color: mix_by(&right.color, &frame.color, &core),
        ..right.clone()
    }
}

/// Erases an object: what surrounds its smear replaces it.
fn erase(right: &Picture, frame: &Frame, name: &str) -> Picture {
    let object = frame
        .objects
        .iter()
        .position(|object_name| object_name == name)
        .unwrap();
    let matte = &right.coverage[object];
    let shown = matte.map(|matte| f32::from(*matte > 0.0));
    // A matte of known pixels is blurred with their colours, which are divided by it.
    let known = Picture {
        color: right.color.zip(&shown, |color, shown| {
            color.map(|part| part * (1.0 - shown))
        }),
        coverage: vec![shown.map(|shown| 1.0 - shown)],
    };
    let spread = blur_isotropically(&known, FILLED);
    let filled = (spread.color).zip(&spread.coverage[0], |color, known| {
        color.map(|part| part / known.max(f32::MIN_POSITIVE))
    });
    Picture {
        color: mix_by(&right.color, &filled, &shown),
        ..right.clone()
    }
}

/// Fills what the instant hides with black.
fn guess_badly(right: &Picture, truth: &Truth) -> Picture {
    let black = right.color.map(|_| [0.0; 3]);
    Picture {
        color: mix_by(&right.color, &black, &truth.at_instant_mean().unknowable),
        ..right.clone()
    }
}

/// Fills the unknowable part with its own colours, without their detail.
fn guess_well(right: &Picture, truth: &Truth) -> Picture {
    let blurred = blur_isotropically(right, GUESS).color;
    Picture {
        color: mix_by(&right.color, &blurred, &truth.at_instant_mean().unknowable),
        ..right.clone()
    }
}

/// Mixes two images by the share of the second in each pixel.
fn mix_by(first: &Image, second: &Image, share: &Plane) -> Image {
    let pairs: Raster<[[f32; 3]; 2]> = first.zip(second, |a, b| [*a, *b]);
    pairs.zip(share, |[a, b], share| {
        std::array::from_fn(|c| (1.0 - share) * a[c] + share * b[c])
    })
}
