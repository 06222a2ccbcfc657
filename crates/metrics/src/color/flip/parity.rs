//! Comparison with `flip-rs`, a port of NVIDIA's tool, pixel by pixel.

use flip_rs::{DEFAULT_PPD, HdrOptions, RgbImage, hdr_flip, ldr_flip};
use frame::{Image, Plane, Raster, display_srgb};

use super::{flip_hdr, flip_ldr};
use crate::Viewing;

/// Sizes around those of bands, of blocks and of filters.
const SIZES: [(u32, u32); 7] = [
    (1, 1),
    (3, 200),
    (31, 9),
    (32, 64),
    (61, 43),
    (130, 65),
    (321, 181),
];

const VIEWING: Viewing = Viewing {
    stops: 0.5,
    flip_start: -2.0,
    flip_stop: 2.0,
    flip_count: 5,
};

/// Makes a picture of a flat part, a ramp, an edge, and fine grain in a part of it; brighter than
/// display white in places.
fn picture(width: u32, height: u32, seed: u32) -> Image {
    Raster::from_fn(width, height, |x, y| {
        let mixed = (x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663) ^ seed)
            .wrapping_mul(2_654_435_761);
        let grain = if x > width / 2 {
            (mixed >> 16) as f32 / 65_536.0
        } else {
            0.0
        };
        let edge = if (x + y + seed).is_multiple_of(23) {
            1.5
        } else {
            0.2
        };
        let ramp = y as f32 / height as f32;
        [
            edge,
            ramp * 0.7 + grain * 0.3,
            grain * 0.1 + 0.05 * seed as f32,
        ]
    })
}

fn interleave(image: &Image) -> RgbImage<f32> {
    let pixels = image.pixels.as_flattened().to_vec();
    RgbImage::new(image.width as usize, image.height as usize, pixels).expect("a whole picture")
}

#[track_caller]
fn assert_equal(found: &Plane, expected: &[f32]) {
    let apart = found.pixels.iter().zip(expected);
    let apart = apart.map(|(found, expected)| (found - expected).abs());
    let largest = apart.fold(0.0, f32::max);
    // Sums are the same; our powers are rounded from 64 bits, and the library's are off
    // by little more than half a step.
    assert!(
        largest <= 1e-6,
        "{largest} at {}x{}",
        found.width,
        found.height
    );
}

#[test]
fn ldr_flip_equals_the_port_in_every_pixel() {
    for (width, height) in SIZES {
        let [truth, output] = [1, 2].map(|seed| picture(width, height, seed));
        let [reference, test] =
            [&truth, &output].map(|image| interleave(&display_srgb(image, VIEWING.stops)));
        let expected = ldr_flip(&reference, &test, DEFAULT_PPD).expect("valid pictures");
        assert_equal(&flip_ldr(&truth, &output, &VIEWING), expected.pixels());
        assert_equal(
            &flip_ldr(&truth, &truth, &VIEWING),
            &vec![0.0; truth.pixels.len()],
        );
    }
}

#[test]
fn hdr_flip_equals_the_port_in_every_pixel() {
    let mut options = HdrOptions::default();
    options.start_exposure = Some(VIEWING.flip_start);
    options.stop_exposure = Some(VIEWING.flip_stop);
    options.num_exposures = Some(VIEWING.flip_count as usize);
    for (width, height) in SIZES {
        let [truth, output] = [1, 2].map(|seed| picture(width, height, seed));
        let expected =
            hdr_flip(&interleave(&truth), &interleave(&output), options).expect("valid pictures");
        let found = flip_hdr(&truth, &output, &VIEWING);
        assert_equal(&found, expected.error_map.pixels());
    }
}
