//! A sky with clouds, as an environment map.

use std::f64::consts::PI;

use image::codecs::hdr::HdrEncoder;

use crate::files::Files;
use crate::noise::soft_noise;

/// Texels around the horizon, and twice the texels from nadir to zenith.
const AROUND: u32 = 1024;

/// Lowest and highest angle of clouds above the horizon, in radians. The even sky above them
/// compresses well.
const CLOUDS: [f64; 2] = [0.03, 0.6];

pub(crate) fn files() -> Files {
    let texels: Vec<image::Rgb<f32>> = (0..AROUND / 2)
        .flat_map(|y| (0..AROUND).map(move |x| image::Rgb(radiance(x, y))))
        .collect();
    let mut bytes = Vec::new();
    HdrEncoder::new(&mut bytes)
        .encode(&texels, AROUND as usize, AROUND as usize / 2)
        .expect("a picture can be written to memory");
    vec![("sky.hdr".into(), bytes)]
}

/// Linear radiance of a texel; `y` counts from the zenith.
fn radiance(x: u32, y: u32) -> [f32; 3] {
    let height = 0.5 * PI - PI * (f64::from(y) + 0.5) / f64::from(AROUND / 2);
    let clear = if height > 0.0 {
        let up = (height / CLOUDS[1]).min(1.0);
        [0.75 - 0.5 * up, 0.85 - 0.4 * up, 1.0 - 0.1 * up]
    } else {
        [0.22, 0.21, 0.2]
    };
    let [low, high] = CLOUDS;
    let belt = ((height - low) / 0.06)
        .min((high - height) / 0.2)
        .clamp(0.0, 1.0);
    let soft = |size: u32, weight: f64| weight * (soft_noise(x, 2 * y, size, AROUND) - 0.5);
    let billows = soft(128, 1.0) + soft(64, 0.7) + soft(32, 0.5) + soft(16, 0.35) + soft(8, 0.2);
    let cloud = belt * (4.0 * billows).clamp(0.0, 1.0);
    let white = 1.25 + soft(16, 0.5);
    // Steps of a 64th hide differences between the sines of machines.
    clear.map(|part| ((part + cloud * (white - part)) * 64.0).round() as f32 / 64.0)
}
