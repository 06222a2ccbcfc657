//! Regions, which depend on scene, shutter and size but not on a truth's noise.

use frame::{Alignment, Replicate, Truth, TruthError};
use metrics::{Region, Regions, measure, regions};
use tests::synthetic::{Object, Sampling, Scene, Shape, VIEWING};
use tracer::TruthTracer;

use crate::renders::*;

fn count(regions: &Regions, region: Region) -> usize {
    let all = regions.moving.map(|_| ());
    regions.select(region, &all).len()
}

/// Fails unless the support contains nearly all coverage.
pub fn expect_support(scene: &str, truth: &Truth) {
    let mean = truth.mean();
    for (object, seen) in truth.support.seen.iter().enumerate() {
        let matte = &mean.coverage[object].pixels;
        let sum = |wanted: bool| -> f64 {
            let pixels = matte.iter().zip(&seen.pixels);
            let pixels = pixels.filter(|(_, seen)| **seen == wanted);
            pixels.map(|(matte, _)| f64::from(*matte)).sum()
        };
        let (missed, held) = (sum(false), sum(true));
        // 64 rays miss half of the objects that cover a hundredth of a pixel. Wires are worst, with
        // 0.24 %.
        assert!(
            missed <= 0.005 * (missed + held) + 0.01,
            "{scene}, object {object}: misses {missed}, holds {held}"
        );
    }
}

/// Expects a support that depends on no noise and holds nearly all coverage.
fn assert_support(name: &str) {
    let scene = load_shipped(name);
    let [few, many] = [(16, 2, 1), (128, 4, 2)].map(|(samples, replicates, seed)| {
        let mut settings = tests::settings_of([80, 45], samples, replicates);
        settings.seed = seed;
        render_truth(&scene, &settings, Alignment::Trailing)
    });
    expect_support(name, &many);
    assert!(few.motion != many.motion, "{name}: noise differs");
    assert!(few.support == many.support, "{name}");
    let [few, many] = [regions(&few), regions(&many)];
    assert!(few == many, "{name}");
    assert!(count(&few, Region::Support) > 0, "{name}");
}

#[test]
fn the_support_depends_on_no_noise_and_holds_nearly_all_coverage() {
    assert_support("wires");
}

#[test]
#[ignore = "prove: scenes of larger things"]
fn the_support_of_larger_things_depends_on_no_noise_and_holds_nearly_all_coverage() {
    ["two_spheres", "fan"].into_iter().for_each(assert_support);
}

#[test]
fn replicates_with_different_supports_are_refused() {
    let scene = load_shipped("two_spheres");
    let settings = settings([16, 9], 16);
    let tracer = TruthTracer::new(&scene, &settings, &[Alignment::Trailing]).unwrap();
    let trace = |index| tracer.trace(index, &unwatched).unwrap().remove(0);
    let mut replicates: [Replicate; 2] = [0, 1].map(trace);
    assert!(Truth::of(&replicates).is_ok());
    let pixel = &mut replicates[1].support.moving.pixels[0];
    *pixel = !*pixel;
    let refused = TruthError::Unlike {
        index: 1,
        what: "support",
    };
    assert_eq!(Truth::of(&replicates), Err(refused));
}

#[test]
fn the_margin_does_not_dilute_an_error_over_the_support() {
    let scene = Scene {
        width: 90,
        height: 90,
        objects: vec![Object::sliding(Shape::Disc(6.0), [50.0, 45.0], [20.0, 0.0])],
    };
    let (frame, truth) = (scene.frame(), scene.truth([Sampling::CLEAN; 2]));
    let parts = regions(&truth);
    let [support, moving] = [Region::Support, Region::Moving].map(|region| count(&parts, region));
    assert!(moving > 2 * support, "{moving} {support}");
    let mut output = truth.mean();
    output.color = (output.color).zip(&parts.support, |color, moves| {
        color.map(|value| if *moves { value + 0.1 } else { value })
    });
    let measured = measure(&output, &frame, &truth, None, &VIEWING).unwrap();
    let value = |name: &str| measured.scores.get(name.parse().unwrap()).value().unwrap();
    let ratio = value("mse_support") / value("mse_moving");
    // Colours are rounded to 32 bits.
    assert!((ratio / (moving as f64 / support as f64) - 1.0).abs() < 1e-6);
    assert!(value("flip_support") > 1.5 * value("flip_moving"));
}
