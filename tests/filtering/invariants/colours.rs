//! Output colours: unchanged, constant, bounded, and linear.

use frame::{Image, Raster, Reprojection};
use tests::presets::{every_preset, gain, preset_name};

use super::{HEIGHT, WIDTH, blur, blur_colors, random};
use crate::fields::Field;

/// Fails unless every preset leaves the colours of a field, except for its gain, unchanged bit for
/// bit.
fn assert_unchanged(field: &Field) {
    for (filter, settings) in every_preset() {
        let gain = gain(&filter, &settings);
        let expected = field.color.map(|pixel| pixel.map(|value| value * gain));
        let output = blur(field, &filter, &settings);
        assert!(output == expected, "{}", preset_name(&filter, &settings));
    }
}

fn brightest(image: &Image) -> f32 {
    let values = image.pixels.as_flattened().iter();
    values.copied().fold(0.0, f32::max)
}

#[test]
fn a_still_frame_comes_out_unchanged() {
    let mut field = random(1);
    field.velocity = Raster::filled(WIDTH, HEIGHT, [0.0, 0.0]);
    field.reprojection = Some(Reprojection::STILL);
    // A still pixel has nothing to average.
    assert_unchanged(&field);
}

#[test]
fn a_constant_colour_comes_out_constant() {
    for color in [[0.2, 0.7, 0.0], [1e4, 3.3e-5, 1.0]] {
        let mut field = random(2);
        field.color = Raster::filled(WIDTH, HEIGHT, color);
        // A running mean of equal values changes nothing.
        assert_unchanged(&field);
    }
}

fn expect_colors_of_the_frame(seed: u64) {
    let field = random(seed);
    for (filter, settings) in every_preset() {
        let output = blur(&field, &filter, &settings);
        if filter.name == "godot" && settings.preset != "engine" {
            // The add-on's taps that weigh over 1 take away from what is below them.
            let mut values = output.pixels.iter().flatten();
            assert!(values.clone().all(|value| value.is_finite()));
            assert!(values.any(|value| *value < -1.0));
            continue;
        }
        for channel in 0..3 {
            let only = |image: &Image| image.map(|pixel| [pixel[channel]; 3]);
            let brightest = brightest(&only(&field.color)) * gain(&filter, &settings);
            // Weights are not negative. Rounding of a mean of 20 taps may exceed the limits by a
            // few parts in 1e6.
            let slack = 1e-5 * brightest;
            for [value, ..] in only(&output).pixels {
                assert!(
                    value.is_finite() && value >= -slack && value <= brightest + slack,
                    "{}: {value} from colours of 0 to {brightest}",
                    preset_name(&filter, &settings)
                );
            }
        }
    }
}

#[test]
fn output_stays_finite_and_within_the_colours_of_the_frame() {
    expect_colors_of_the_frame(3);
}

#[test]
#[ignore = "prove: twenty more fields of noise"]
fn output_stays_within_the_colours_of_every_frame() {
    (4..24).for_each(expect_colors_of_the_frame);
}

#[test]
fn every_colour_goes_through_the_same_weights() {
    let field = random(8);
    let matte = (field.color).map(|[r, ..]| if *r > 0.5 { [1.0, 0.0, 0.5] } else { [0.0; 3] });
    for (filter, settings) in every_preset() {
        let name = preset_name(&filter, &settings);
        let together = blur_colors(
            &field,
            &filter,
            &settings,
            &[&field.color, &matte, &field.color],
        );
        let alone = blur_colors(&field, &filter, &settings, &[&matte]);
        assert!(together[1] == alone[0], "{name}");
        assert!(together[0] == together[2], "{name}");
    }
}

#[test]
fn a_mixture_of_images_comes_out_as_the_mixture_of_their_blurs() {
    let [field, other] = [random(11), random(12)];
    let mix = |a: &Image, b: &Image| a.zip(b, |a, b| [0, 1, 2].map(|c| 0.25 * a[c] + 0.75 * b[c]));
    let mixture = mix(&field.color, &other.color);
    for (filter, settings) in every_preset() {
        let colors = [&field.color, &other.color, &mixture];
        let outputs = blur_colors(&field, &filter, &settings, &colors);
        let expected = mix(&outputs[0], &outputs[1]);
        let apart = expected.zip(&outputs[2], |a, b| [0, 1, 2].map(|c| (a[c] - b[c]).abs()));
        let deviation = brightest(&apart) / brightest(&field.color);
        let name = preset_name(&filter, &settings);
        // Up to a hundred taps, each a product and a sum in 32-bit floats.
        assert!(deviation <= 1e-5, "{name}: {deviation:.1e}");
    }
}
