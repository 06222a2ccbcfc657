//! Regions, which depend on scene, shutter and size but not on a truth's noise.

use frame::{Alignment, Replicate, Truth, TruthError};
use metrics::{Region, Regions, measure, regions};
use tests::synthetic::{Object, Sampling, Scene, Shape, VIEWING};
use tests::unwatched;
use tracer::{RenderSettings, TruthTracer, load_scene, trace_truth};

fn load_shipped(name: &str) -> tracer::Scene {
    load_scene(tests::scenes().join(name), None).unwrap()
}

fn render_settings(samples_per_pixel: u32, replicates: u32, seed: u64) -> RenderSettings {
    RenderSettings {
        width: 80,
        height: 45,
        samples_per_pixel,
        replicates,
        seed,
        ..RenderSettings::default()
    }
}

fn count(regions: &Regions, region: Region) -> usize {
    let all = regions.moving.map(|_| ());
    regions.select(region, &all).len()
}

#[test]
fn regions_depend_on_no_seed_no_samples_and_no_replicates() {
    for name in ["two_spheres", "fan", "railing"] {
        let scene = load_shipped(name);
        let few = trace_truth(
            &scene,
            &render_settings(16, 2, 1),
            Alignment::Trailing,
            &unwatched,
        )
        .unwrap();
        let many = trace_truth(
            &scene,
            &render_settings(256, 4, 2),
            Alignment::Trailing,
            &unwatched,
        )
        .unwrap();
        assert!(few.motion != many.motion, "{name}: noise differs");
        assert!(few.support == many.support, "{name}");
        let regions = [&few, &many].map(regions);
        assert!(regions[0] == regions[1], "{name}");
        assert!(count(&regions[0], Region::Support) > 0, "{name}");
    }
}

#[test]
fn the_support_holds_nearly_all_coverage_of_a_truth() {
    for name in ["two_spheres", "fan", "wires"] {
        let truth = trace_truth(
            &load_shipped(name),
            &render_settings(1024, 2, 1),
            Alignment::Trailing,
            &unwatched,
        )
        .unwrap();
        let mean = truth.mean();
        for (object, seen) in truth.support.seen.iter().enumerate() {
            let missed: f64 = (mean.coverage[object].pixels.iter().zip(&seen.pixels))
                .filter(|(_, seen)| !**seen)
                .map(|(matte, _)| f64::from(*matte))
                .sum();
            let all: f64 = mean.coverage[object]
                .pixels
                .iter()
                .map(|matte| f64::from(*matte))
                .sum();
            // 64 rays miss half of the objects that cover a hundredth of a pixel. Wires are worst, with 0.24 %.
            assert!(
                missed <= 0.005 * all + 0.01,
                "{name}, object {object}: misses {missed} of {all}"
            );
        }
    }
}

#[test]
fn replicates_with_different_supports_are_refused() {
    let scene = load_shipped("two_spheres");
    let tracer =
        TruthTracer::new(&scene, &render_settings(16, 2, 1), &[Alignment::Trailing]).unwrap();
    let mut replicates: Vec<Replicate> = (0..2)
        .flat_map(|index| tracer.trace(index, &unwatched).unwrap())
        .collect();
    assert!(Truth::of(&replicates).is_ok());
    let pixel = &mut replicates[1].support.moving.pixels[0];
    *pixel = !*pixel;
    let refused = Truth::of(&replicates);
    assert_eq!(
        refused,
        Err(TruthError::Unlike {
            index: 1,
            what: "support"
        })
    );
}

#[test]
fn the_margin_does_not_dilute_an_error_over_the_support() {
    let scene = Scene {
        width: 90,
        height: 90,
        objects: vec![Object::sliding(Shape::Disc(6.0), [50.0, 45.0], [20.0, 0.0])],
    };
    let (frame, truth) = (scene.frame(), scene.truth([Sampling::CLEAN; 2]));
    let found = regions(&truth);
    let [support, moving] = [Region::Support, Region::Moving].map(|region| count(&found, region));
    assert!(moving > 2 * support, "{moving} {support}");
    let mut output = truth.mean();
    output.color = (output.color).zip(&found.support, |color, moves| {
        color.map(|value| if *moves { value + 0.1 } else { value })
    });
    let scores = measure(&output, &frame, &truth, None, &VIEWING)
        .unwrap()
        .scores;
    let value = |name: &str| scores.get(name.parse().unwrap()).value().unwrap();
    let ratio = value("mse_support") / value("mse_moving");
    // Colours are rounded to 32 bits.
    assert!(
        (ratio / (moving as f64 / support as f64) - 1.0).abs() < 1e-6,
        "{ratio}"
    );
    assert!(value("flip_support") > 1.5 * value("flip_moving"));
}
