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
const PER_WHITE: [f32; 2] = [1.052_156_9, 0.918_357_7];

/// Exposes radiance by a factor, and maps it to [0, 1] by the ACES curve.
#[inline(always)]
pub fn tone_map(value: f32, factor: f32) -> f32 {
    let x = value * factor;
    let square = x * x;
    let curve = (square * (0.6 * 0.6 * 2.51) + x * (0.6 * 0.03) + 0.0)
        / (square * (0.6 * 0.6 * 2.43) + x * (0.6 * 0.59) + 0.14);
    clamp(curve)
}

/// Converts linear values to the opponent colours in which contrast is filtered: lightness, red to
/// green, blue to yellow.
#[inline(always)]
pub fn to_opponent(color: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = multiply(&TO_XYZ, color);
    let (x, z) = (x * PER_WHITE[0], z * PER_WHITE[1]);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Converts lines of filtered opponent colours to CIELab with Hunt's adjustment, step by step:
/// compilers turn each step into wide instructions.
#[inline(always)]
pub fn to_lab<const LANES: usize>([first, second, third]: &mut [[f32; LANES]; 3]) {
    for lane in 0..LANES {
        let y = (first[lane] + 16.0) / 116.0;
        let x = (y + second[lane] / 500.0) * WHITE[0];
        let z = (y - third[lane] / 200.0) * WHITE[1];
        let [r, g, b] = multiply(&FROM_XYZ, [x, y, z]);
        let [x, y, z] = multiply(&TO_XYZ, [clamp(r), clamp(g), clamp(b)]);
        first[lane] = x * PER_WHITE[0];
        second[lane] = y;
        third[lane] = z * PER_WHITE[1];
    }
    for line in [&mut *first, &mut *second, &mut *third] {
        for value in line {
            *value = bend(*value);
        }
    }
    for lane in 0..LANES {
        let lab = adjust([first[lane], second[lane], third[lane]]);
        first[lane] = lab[0];
        second[lane] = lab[1];
        third[lane] = lab[2];
    }
}

/// Returns the largest distance of two display colours: green to blue, raised to 0.7.
pub fn largest_distance() -> f32 {
    let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|color| {
        let [x, y, z] = multiply(&TO_XYZ, color);
        adjust([x * PER_WHITE[0], y, z * PER_WHITE[1]].map(bend))
    });
    distance(green, blue).powf(0.7)
}

/// Computes the HyAB distance of two colours.
#[inline(always)]
pub fn distance(one: [f32; 3], other: [f32; 3]) -> f32 {
    let (a, b) = (one[1] - other[1], one[2] - other[2]);
    (one[0] - other[0]).abs() + (a * a + b * b).sqrt()
}

/// Applies CIELab's curve to a part of white: a cube root, and a line near 0.
#[inline(always)]
fn bend(value: f32) -> f32 {
    const LEAST: f32 = 6.0 / 29.0;
    const SLOPE: f32 = 1.0 / (3.0 * (LEAST * LEAST));
    let root = power(value, 1.0 / 3.0);
    let line = SLOPE * value + 4.0 / 29.0;
    if value > LEAST * (LEAST * LEAST) {
        root
    } else {
        line
    }
}

/// Computes CIELab from curved parts of white, with Hunt's adjustment: dark colours are less
/// colourful.
#[inline(always)]
fn adjust([x, y, z]: [f32; 3]) -> [f32; 3] {
    let lightness = 116.0 * y - 16.0;
    [
        lightness,
        0.01 * lightness * (500.0 * (x - y)),
        0.01 * lightness * (200.0 * (y - z)),
    ]
}

#[inline(always)]
fn multiply(matrix: &[[f32; 3]; 3], [x, y, z]: [f32; 3]) -> [f32; 3] {
    let [first, second, third] = matrix;
    [
        first[0] * x + first[1] * y + first[2] * z,
        second[0] * x + second[1] * y + second[2] * z,
        third[0] * x + third[1] * y + third[2] * z,
    ]
}

#[inline(always)]
fn clamp(value: f32) -> f32 {
    value.clamp(0.0, 1.0)
}
