//! Output colours: unchanged, constant, bounded, and linear.

use frame::{Image, Raster, Reprojection};
use tests::presets::{every_preset, gain, preset_name};

use super::{Field, HEIGHT, WIDTH, open_gpu};

#[test]
fn a_still_frame_comes_out_unchanged() {
    let gpu = open_gpu();
    let mut field = Field::random(1);
    field.velocity = Raster::filled(WIDTH, HEIGHT, [0.0, 0.0]);
    field.reprojection = Reprojection::STILL;
    for (filter, settings) in every_preset() {
        let output = field.blur(&gpu, &filter, &settings);
        // Bit for bit: a pixel that does not move has nothing to average.
        let expected = brightened(&field.color, gain(&filter, &settings));
        assert!(output == expected, "{}", preset_name(&filter, &settings));
    }
}

fn brightened(image: &Image, gain: f32) -> Image {
    image.map(|pixel| pixel.map(|channel| channel * gain))
}

#[test]
fn a_constant_colour_comes_out_constant() {
    let gpu = open_gpu();
    for color in [[0.2, 0.7, 0.0], [1e4, 3.3e-5, 1.0]] {
        let mut field = Field::random(2);
        field.color = Raster::filled(WIDTH, HEIGHT, color);
        for (filter, settings) in every_preset() {
            let output = field.blur(&gpu, &filter, &settings);
            // Bit for bit: a running mean of equal values changes nothing.
            let expected = brightened(&field.color, gain(&filter, &settings));
            assert!(output == expected, "{}", preset_name(&filter, &settings));
        }
    }
}

#[test]
fn output_stays_finite_and_within_the_colours_of_the_frame() {
    let gpu = open_gpu();
    for seed in 3..6 {
        let field = Field::random(seed);
        for (filter, settings) in every_preset() {
            let output = field.blur(&gpu, &filter, &settings);
            for channel in 0..3 {
                let values = |image: &Image| -> Vec<f32> {
                    image.pixels.iter().map(|pixel| pixel[channel]).collect()
                };
                let brightest =
                    values(&field.color).into_iter().fold(0.0, f32::max) * gain(&filter, &settings);
                for value in values(&output) {
                    // Weights are not negative. Rounding of a mean of 20 taps may exceed the limits by a few parts in
                    // 1e6.
                    let slack = 1e-5 * brightest;
                    assert!(
                        value.is_finite() && value >= -slack && value <= brightest + slack,
                        "{}: {value} from colours of 0 to {brightest}",
                        preset_name(&filter, &settings)
                    );
                }
            }
        }
    }
}

#[test]
fn every_colour_goes_through_the_same_weights() {
    let gpu = open_gpu();
    let field = Field::random(8);
    let matte = field
        .color
        .map(|[r, ..]| if *r > 0.5 { [1.0, 0.0, 0.5] } else { [0.0; 3] });
    for (filter, settings) in every_preset() {
        let colors = [&field.color, &matte, &field.color];
        let together = field.blur_colors(&gpu, &filter, &settings, &colors);
        let alone = field.blur_colors(&gpu, &filter, &settings, &[&matte]);
        assert!(
            together[1] == alone[0],
            "{}",
            preset_name(&filter, &settings)
        );
        assert!(
            together[0] == together[2],
            "{}",
            preset_name(&filter, &settings)
        );
    }
}

#[test]
fn a_mixture_of_images_comes_out_as_the_mixture_of_their_blurs() {
    let gpu = open_gpu();
    let [field, other] = [Field::random(11), Field::random(12)];
    let mix = |a: &Image, b: &Image| a.zip(b, |a, b| [0, 1, 2].map(|c| 0.25 * a[c] + 0.75 * b[c]));
    let mixture = mix(&field.color, &other.color);
    let brightest = field
        .color
        .pixels
        .as_flattened()
        .iter()
        .copied()
        .fold(0.0, f32::max);
    for (filter, settings) in every_preset() {
        let colors = [&field.color, &other.color, &mixture];
        let outputs = field.blur_colors(&gpu, &filter, &settings, &colors);
        let expected = mix(&outputs[0], &outputs[1]);
        let deviation = expected
            .zip(&outputs[2], |a, b| [0, 1, 2].map(|c| (a[c] - b[c]).abs()))
            .pixels
            .as_flattened()
            .iter()
            .copied()
            .fold(0.0, f32::max);
        println!(
            "{}: {:.1e} of the brightest",
            preset_name(&filter, &settings),
            deviation / brightest
        );
        // Up to a hundred taps, each a product and a sum in 32-bit floats.
        assert!(
            deviation <= 1e-5 * brightest,
            "{}",
            preset_name(&filter, &settings)
        );
    }
}
