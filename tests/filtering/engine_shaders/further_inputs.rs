//! Inputs that few frames have: the velocity to the next frame, and the velocity of depth.

use filters::{Filter, Input, Layer};
use tests::filter_folder::write_kernel;
use tests::near::assert_near;
use tests::text::assert_contains;

use super::{busy_picture, make_declared};
use crate::filter_files::ready;

/// Makes filters that show both: kernels bound by name, and a shader of an engine with a
/// convention.
fn make_both() -> [Filter; 2] {
    let folder = tempfile::tempdir().unwrap();
    let shows = "let z = textureLoad(velocity_z, pixel, 0).x;
        textureStore(output, pixel, vec4<f32>(textureLoad(velocity_next, pixel, 0).xy, z, 1.0));";
    let named = folder.path().join("named");
    write_kernel(&named, "", &["velocity_next", "velocity_z"], shows);
    [
        Filter::load(&named).unwrap(),
        make_declared("conventions", "further_inputs.toml")
            .load()
            .unwrap(),
    ]
}

#[test]
fn shaders_read_them_by_name_and_in_the_convention_of_velocity() {
    let picture = busy_picture();
    let black = picture.color.map(|_| [0.0; 3]);
    let next = picture
        .velocity
        .map(|[right, down]| [right + 1.0, down - 2.0]);
    let away = picture.depth.map(|depth| 0.25 * depth);
    let colors = [&black];
    let input = Input {
        velocity_next: Some(&next),
        velocity_z: Some(&away),
        ..picture.input(&colors)
    };
    // 61 x 43 pixels, exposure 0.7; pixel (12, 9) is 14 m away.
    let factors = [[1.0, 1.0, 1.0], [1.4 / 61.0, -1.4 / 43.0, 1.0]];
    for (filter, factors) in make_both().iter().zip(factors) {
        let layers = [Layer::VelocityNext, Layer::VelocityZ];
        assert_eq!(filter.further_inputs(), layers);
        let output = ready(filter, (61, 43))
            .unwrap()
            .run(&input)
            .unwrap()
            .remove(0);
        let actual = output.at(12, 9).map(f64::from);
        for (axis, expected) in [10.5, -6.25, 3.5].into_iter().enumerate() {
            assert_near(actual[axis], factors[axis] * expected, 1e-5);
        }
    }
}

#[test]
fn frames_without_them_are_refused() {
    let picture = busy_picture();
    let colors = [&picture.color];
    let without = Input {
        velocity_next: None,
        ..picture.input(&colors)
    };
    let mut broken = picture.velocity.clone();
    broken.pixels[62] = [0.0, f32::NAN];
    let next = Some(&picture.velocity);
    #[rustfmt::skip]
    let wrong = [
        (without, "the frame has no velocity_next, which this filter reads; render it with `truths render --further-velocities`"),
        (Input { velocity_next: next, ..without }, "the frame has no velocity_z"),
        (Input { velocity_next: Some(&broken), ..without }, "velocity_next at (1, 1) is not finite"),
    ];
    for filter in make_both() {
        let mut blur = ready(&filter, (61, 43)).unwrap();
        for (input, says) in &wrong {
            let error = blur.run(input).unwrap_err().to_string();
            assert_contains(&error, &[filter.name.as_str(), says]);
        }
    }
    let identity = Filter::builtin("identity").unwrap();
    assert!(identity.further_inputs().is_empty());
    ready(&identity, (61, 43)).unwrap().run(&without).unwrap();
}

#[test]
fn a_mask_arrives_as_it_is_and_holds_shares() {
    let picture = busy_picture();
    let folder = tempfile::tempdir().unwrap();
    let shows = "textureStore(output, pixel, vec4<f32>(textureLoad(exclusion, pixel, 0).x));";
    write_kernel(&folder.path().join("mask"), "", &["exclusion"], shows);
    let filter = Filter::load(&folder.path().join("mask")).unwrap();
    let mask = picture.depth.map(|depth| f32::from(*depth < 20.0));
    let mut broken = mask.clone();
    broken.pixels[62] = 1.5;
    let colors = [&picture.color];
    let input = |mask| Input {
        exclusion: mask,
        ..picture.input(&colors)
    };
    let mut blur = ready(&filter, (61, 43)).unwrap();
    let output = blur.run(&input(Some(&mask))).unwrap().remove(0);
    assert!(output.map(|pixel| pixel[0]) == mask);
    assert!(!filter.reads_further_velocities());
    for (mask, says) in [
        (None, "the frame has no exclusion, which this filter reads"),
        (Some(&broken), "exclusion at (1, 1) is not from 0 to 1"),
    ] {
        let error = blur.run(&input(mask)).unwrap_err().to_string();
        assert_contains(&error, &[says]);
    }
}
