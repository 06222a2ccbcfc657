//! Output colours: unchanged, constant, bounded, and linear.

use frame::{Image, Raster, Reprojection};
use tests::presets::{every_preset, gain};

use super::{HEIGHT, Subject, WIDTH, random};
use crate::fields::Field;

/// Fails unless a preset leaves colours over a field, except for its gain, unchanged bit for bit.
fn assert_unchanged(subject: &mut Subject, field: &Field, colors: &[&Image]) {
    let gain = gain(&subject.filter, &subject.settings);
    let outputs = subject.run(field, colors);
    assert_eq!(outputs.len(), colors.len());
    for (color, output) in colors.iter().zip(outputs) {
        let expected = color.map(|pixel| pixel.map(|value| value * gain));
        assert!(output == expected, "{}", subject.name);
    }
}

fn brightest(image: &Image) -> f32 {
    let values = image.pixels.as_flattened().iter();
    values.copied().fold(0.0, f32::max)
}

pub fn a_still_frame_comes_out_unchanged(subject: &mut Subject) {
    let mut field = random(1);
    field.velocity = Raster::filled(WIDTH, HEIGHT, [0.0, 0.0]);
    field.reprojection = Some(Reprojection::STILL);
    // A still pixel has nothing to average.
    assert_unchanged(subject, &field, &[&field.color]);
}

pub fn a_constant_colour_comes_out_constant(subject: &mut Subject) {
    let colors = [[0.2, 0.7, 0.0], [1e4, 3.3e-5, 1.0]];
    let [dim, bright] = colors.map(|color| Raster::filled(WIDTH, HEIGHT, color));
    // A running mean of equal values changes nothing.
    assert_unchanged(subject, &random(2), &[&dim, &bright]);
}

fn expect_colors_of_the_frame(subject: &mut Subject, seed: u64) {
    let field = random(seed);
    let output = subject.run(&field, &[&field.color]).remove(0);
    if subject.filter.name == "godot" && subject.settings.preset != "engine" {
        // The add-on's taps that weigh over 1 take away from what is below them.
        let mut values = output.pixels.iter().flatten();
        assert!(values.clone().all(|value| value.is_finite()));
        assert!(values.any(|value| *value < -1.0));
        return;
    }
    for channel in 0..3 {
        let only = |image: &Image| image.map(|pixel| [pixel[channel]; 3]);
        let brightest = brightest(&only(&field.color)) * gain(&subject.filter, &subject.settings);
        // Weights are not negative. Rounding of a mean of 20 taps may exceed the limits by a few
        // parts in 1e6.
        let slack = 1e-5 * brightest;
        for [value, ..] in only(&output).pixels {
            assert!(
                value.is_finite() && value >= -slack && value <= brightest + slack,
                "{}: {value} from colours of 0 to {brightest}",
                subject.name
            );
        }
    }
}

pub fn output_stays_finite_and_within_the_colours_of_the_frame(subject: &mut Subject) {
    expect_colors_of_the_frame(subject, 3);
}

#[test]
#[ignore = "prove: twenty more fields of noise"]
fn output_stays_within_the_colours_of_every_frame() {
    for (filter, settings) in every_preset() {
        let mut subject = Subject::new(filter, settings);
        (4..24).for_each(|seed| expect_colors_of_the_frame(&mut subject, seed));
    }
}

pub fn a_mixture_of_images_comes_out_as_the_mixture_of_their_blurs(subject: &mut Subject) {
    let [field, other] = [random(11), random(12)];
    let mix = |a: &Image, b: &Image| a.zip(b, |a, b| [0, 1, 2].map(|c| 0.25 * a[c] + 0.75 * b[c]));
    let mixture = mix(&field.color, &other.color);
    let outputs = subject.run(&field, &[&field.color, &other.color, &mixture]);
    let expected = mix(&outputs[0], &outputs[1]);
    let apart = expected.zip(&outputs[2], |a, b| [0, 1, 2].map(|c| (a[c] - b[c]).abs()));
    let deviation = brightest(&apart) / brightest(&field.color);
    // Up to a hundred taps, each a product and a sum in 32-bit floats.
    assert!(deviation <= 1e-5, "{}: {deviation:.1e}", subject.name);
}
