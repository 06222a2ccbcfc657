//! The presets of Unity HDRP.

use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, Surface, light, white};

const BACKGROUND: Surface = BLACK_WALL.moving(24.0, 0.0);

#[test]
fn the_noise_of_hdrp_shifts_all_taps_of_a_pixel_to_one_side() {
    // Brightness is the column, so a mean of taps is their mean position.
    let picture = Picture::new(200, 64, |x, _| white(24.0).gray(x as f32));
    let output = picture.blur("jimenez", "hdrp", "");
    let pixels = (50..150).flat_map(|x| (0..48).map(move |y| (x, y)));
    let shifts: Vec<f32> = pixels.map(|(x, y)| output.at(x, y)[0] - x as f32).collect();
    let mean = shifts.iter().map(|shift| shift.abs()).sum::<f32>() / shifts.len() as f32;
    // Taps shift by up to half a step of 3 pixels. With nearest fetches, a third of the noise
    // shifts them by 1.5 pixels and the rest by 0.5. Mirrored taps would not shift.
    assert_near(mean, 5.0 / 6.0, 0.05);
}

#[test]
fn hdrp_reads_the_nearest_pixels_and_fewer_on_short_trails() {
    // The second trail has a little over 5 pixels. Its length counts in parts of the picture's
    // diagonal, which makes it a tenth longer.
    for (speed, taps) in [(25.0, 8.0), (2.4, 6.0)] {
        let stripes = Picture::new(160, 64, |x, _| white(speed).gray((x % 2) as f32));
        for pixel in &stripes.blur("jimenez", "hdrp", "").pixels {
            // All taps have equal weight: each pixel is a mean of zeros and ones.
            let ones = taps * pixel[0];
            assert_near(ones, ones.round(), 1e-5);
        }
    }
}

/// Makes a speckled background that moves right, with a still black object in front on the left.
fn still_in_front() -> Picture {
    let picture = Picture::halves(160, 64, white(0.0).gray(0.0), BACKGROUND);
    picture.speckled(5, |x, _| x >= 80)
}

#[test]
fn a_still_foreground_stays_sharp() {
    let picture = still_in_front();
    for preset in ["slides_2014", "hdrp", "hdrp_mirrored"] {
        let output = picture.blur("jimenez", preset, "");
        // Up to one step, 12 / pairs pixels, where a still pixel's spread ends.
        assert_eq!(light(&output, 0..76), 0.0, "{preset}");
    }
    // Late steps end at once.
    let output = picture.blur("jimenez", "hdrp", "");
    assert_within(light(&output, 0..80), ..0.01);
}
