//! Conversions of colour for FLIP, with the tool's constants.

use crate::math::power::power;

/// Converts linear Rec.709 to XYZ.
const TO_XYZ: [[f32; 3]; 3] = [
    [
        10_135_552.0 / 24_577_794.0,
        8_788_810.0 / 24_577_794.0,
        4_435_075.0 / 24_577_794.0,
    ],
    [
        2_613_072.0 / 12_288_897.0,
        8_788_810.0 / 12_288_897.0,
        887_015.0 / 12_288_897.0,
    ],
    [
        1_425_312.0 / 73_733_382.0,
        8_788_810.0 / 73_733_382.0,
        70_074_185.0 / 73_733_382.0,
    ],
];

/// Converts XYZ to linear Rec.709.
const FROM_XYZ: [[f32; 3]; 3] = [
    [3.241_003_3, -1.537_398_9, -0.498_615_86],
    [-0.969_224_33, 1.875_930_1, 0.041_554_224],
    [0.055_639_423, -0.204_011_2, 1.057_148_9],
];

/// White's X and Z; its Y is 1.
const WHITE: [f32; 2] = [0.950_428_55, 1.088_900_3];
/// Inverse of [`WHITE`].
const PER_WHITE: [f32; 2] = [1.052_156_9, 0.918_357_67];

/// Decodes an sRGB value in [0, 1].
pub fn decode_srgb(value: f32) -> f32 {
    match value <= 0.04045 {
        true => value / 12.92,
        false => ((value + 0.055) / 1.055).powf(2.4),
    }
}

/// Exposes radiance by a factor, and maps it to [0, 1] by the ACES curve.
#[inline(always)]
pub fn tone_map(color: [f32; 3], factor: f32) -> [f32; 3] {
    color.map(|value| {
        let x = value * factor;
        let square = x * x;
        let curve = (square * (0.6 * 0.6 * 2.51) + x * (0.6 * 0.03) + 0.0)
            / (square * (0.6 * 0.6 * 2.43) + x * (0.6 * 0.59) + 0.14);
        clamp(curve)
    })
}

/// Converts linear values to the opponent colours in which contrast is filtered: lightness, red to green, blue to yellow.
#[inline(always)]
pub fn to_opponent(color: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = multiply(&TO_XYZ, color);
    let (x, z) = (x * PER_WHITE[0], z * PER_WHITE[1]);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Converts filtered opponent colours to CIELab with Hunt's adjustment.
#[inline(always)]
pub fn to_lab([lightness, red_green, blue_yellow]: [f32; 3]) -> [f32; 3] {
    let y = (lightness + 16.0) / 116.0;
    let x = (y + red_green / 500.0) * WHITE[0];
    let z = (y - blue_yellow / 200.0) * WHITE[1];
    hunt_lab(multiply(&FROM_XYZ, [x, y, z]).map(clamp))
}

/// Returns the largest distance of two colours of a display: that of green and blue, raised to 0.7.
pub fn largest_distance() -> f32 {
    let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(hunt_lab);
    distance(green, blue).powf(0.7)
}

/// Computes the HyAB distance of two colours.
#[inline(always)]
pub fn distance(one: [f32; 3], other: [f32; 3]) -> f32 {
    let [l, a, b] = [0, 1, 2].map(|c| one[c] - other[c]);
    l.abs() + (a * a + b * b).sqrt()
}

#[inline(always)]
fn hunt_lab(color: [f32; 3]) -> [f32; 3] {
    const LEAST: f32 = 6.0 / 29.0;
    const SLOPE: f32 = 1.0 / (3.0 * (LEAST * LEAST));
    let [x, y, z] = multiply(&TO_XYZ, color);
    let [x, y, z] = [x * PER_WHITE[0], y, z * PER_WHITE[1]].map(|value| {
        let root = power(value, 1.0 / 3.0);
        match value > LEAST * (LEAST * LEAST) {
            true => root,
            false => SLOPE * value + 4.0 / 29.0,
        }
    });
    let lightness = 116.0 * y - 16.0;
    [
        lightness,
        0.01 * lightness * (500.0 * (x - y)),
        0.01 * lightness * (200.0 * (y - z)),
    ]
}

#[inline(always)]
fn multiply(matrix: &[[f32; 3]; 3], [x, y, z]: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|row| {
        let [a, b, c] = matrix[row];
        a * x + b * y + c * z
    })
}

#[inline(always)]
fn clamp(value: f32) -> f32 {
    value.clamp(0.0, 1.0)
}
