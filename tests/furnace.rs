//! Scenes whose radiance is known in closed form.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use frame::{Alignment, Truth};
use glam::{DQuat, DVec3, Vec3};
use tests::shapes::*;
use tracer::{Background, Key, Material, Motion, Scene, Sun, TruthSettings, trace_truth};

fn truth(scene: &Scene, samples_per_pixel: u32) -> Truth {
    let settings = TruthSettings {
        width: 16,
        height: 9,
        exposure: 1.0,
        alignment: Alignment::Centred,
        samples_per_pixel,
        ..TruthSettings::default()
    };
    trace_truth(scene, &settings, &|_| ControlFlow::Continue(())).expect("settings are allowed")
}

/// Every pixel's first component within 4.5 standard errors of `expected`, plus `rounding`; the mean of all within
/// 4.5 of its own.
fn expect_everywhere(truth: &Truth, expected: f64) {
    let mean = truth.mean();
    let mut sum = 0.0;
    let mut variance = 0.0;
    for (color, error) in mean.color.pixels.iter().zip(&truth.standard_error.pixels) {
        let difference = f64::from(color[0]) - expected;
        let error = f64::from(error[0]);
        // 8 replicates: Student's t with 7 degrees of freedom exceeds 11 once in 1e5; 144 pixels.
        // 3e-6: rounding of f32 throughputs over tens of bounces.
        assert!(
            difference.abs() <= 11.0 * error + 3e-6 * expected,
            "radiance {} is not {expected} within 11 standard errors of {error}",
            color[0]
        );
        sum += difference;
        variance += error * error;
    }
    // The errors of independent pixels add in squares; 4.5 sigma of a normal distribution is 7e-6.
    assert!(
        sum.abs() <= 4.5 * variance.sqrt() + 3e-6 * expected * mean.color.pixels.len() as f64,
        "mean is off by {} standard errors",
        sum / variance.sqrt()
    );
}

#[test]
fn a_closed_glowing_sphere_has_the_radiance_of_the_geometric_series() {
    for albedo in [0.2, 0.5, 0.8] {
        let mut scene = empty_scene("furnace");
        let walls = Material {
            emission: Vec3::splat(1.0 - albedo),
            ..diffuse(albedo)
        };
        add(
            &mut scene,
            icosphere(3.0, 2),
            walls,
            spin(DVec3::ZERO, DVec3::Y, 2.0),
        );
        expect_everywhere(&truth(&scene, 512), 1.0);
    }
}
