//! Common parts of references in 64-bit floats: runs of a filter on fields, and the noise of a
//! pixel.

use std::collections::BTreeMap;

use filters::{Blur, Filter, Settings, Value};
use frame::{Image, Raster};
use tests::picture::change_preset;
use tests::ready_blur;
use tests::vector::Vec2;

use crate::fields::{self, Field, rectangles};

pub const FRAME_INDEX: u32 = 11;

/// A filter, its preset, changes to it such as `samples=9 jitter=none`, and the exposure in frames.
pub type Case = (&'static str, &'static str, &'static str, f64);

/// A case on a field, with its picture and some of its textures.
pub struct Run {
    pub name: String,
    pub filter: &'static str,
    pub settings: Settings,
    pub field: Field,
    pub output: Image,
    textures: BTreeMap<&'static str, Raster<[f32; 4]>>,
}

/// Runs every case on fields of odd sizes, wide and tall, none a multiple of a tile; two of random
/// pixels, two of objects over a slow background.
pub fn run_cases(cases: &[Case], textures: &[&'static str]) -> Vec<Run> {
    let mut runs = Vec::new();
    for (name, preset, changes, exposure) in cases {
        let filter = Filter::builtin(name).unwrap();
        for (kind, mut field) in [
            ("noise 61x37", fields::noise(61, 37, 1)),
            ("noise 31x71", fields::noise(31, 71, 2)),
            ("rectangles 97x53", rectangles(97, 53, 3)),
            ("rectangles 61x67", rectangles(61, 67, 4)),
        ] {
            let settings = change_preset(&filter, Some(preset), changes);
            let size = (field.color.width, field.color.height);
            let mut blur: Blur = ready_blur(&filter, &settings, size);
            field.exposure = *exposure;
            let output = field.blur(&mut blur, FRAME_INDEX);
            let read = |name: &&'static str| (*name, blur.read_texture(name).unwrap());
            runs.push(Run {
                name: format!("{name} {preset} {changes} at {exposure} on {kind}"),
                filter: name,
                textures: textures.iter().map(read).collect(),
                output,
                settings,
                field,
            });
        }
    }
    runs
}

impl Run {
    pub fn integer(&self, name: &str) -> i64 {
        match self.settings.values[name] {
            Value::Integer(value) => value.into(),
            _ => panic!("{name} is an integer"),
        }
    }

    pub fn real(&self, name: &str) -> f64 {
        match self.settings.values[name] {
            Value::Real(value) => value,
            _ => panic!("{name} is a real number"),
        }
    }

    pub fn choice(&self, name: &str) -> String {
        self.settings.values[name].to_string()
    }

    pub fn texture(&self, name: &str) -> &Raster<[f32; 4]> {
        &self.textures[name]
    }

    pub fn size(&self) -> [i64; 2] {
        [self.output.width.into(), self.output.height.into()]
    }

    pub fn pixels(&self) -> impl Iterator<Item = [i64; 2]> + use<> {
        let [width, height] = self.size();
        (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
    }

    /// Fails unless a pixel of the output has this colour.
    pub fn assert_color(&self, pixel: [i64; 2], expected: [f64; 3], tolerance: f64) {
        let actual = self.output.at(pixel[0] as u32, pixel[1] as u32);
        let is_near = |c: usize| (expected[c] - f64::from(actual[c])).abs() < tolerance;
        assert!(
            (0..3).all(is_near),
            "{}: pixel {pixel:?} is {actual:?}; the reference says {expected:?} +- {tolerance}",
            self.name
        );
    }
}

/// Computes interleaved gradient noise of a pixel on a cycle of 8 frames, `offset` pixels further
/// right and down; none if it may wrap around in 32-bit floats that err by `error`.
pub fn noise(pixel: [i64; 2], offset: f64, error: f64) -> Option<f64> {
    let frame = f64::from(FRAME_INDEX % 8);
    let x = pixel[0] as f64 + frame * 47.0 * 0.695 + offset;
    let y = pixel[1] as f64 + frame * 17.0 * 0.695 + offset;
    let inner = (0.067_110_56 * x + 0.005_837_15 * y).fract();
    let noise = (52.982_918_9 * inner).fract();
    let clear = |value: f64, margin: f64| value > margin && value < 1.0 - margin;
    (clear(inner, error / 50.0) && clear(noise, error)).then_some(noise)
}

/// Reads a texel, or the nearest one at the edge.
pub fn read_clamped<T: Copy>(raster: &Raster<T>, x: i64, y: i64) -> T {
    let x = x.clamp(0, i64::from(raster.width) - 1);
    let y = y.clamp(0, i64::from(raster.height) - 1);
    *raster.at(x as u32, y as u32)
}

/// Samples like a linear sampler, at a position in pixels.
pub fn sample_linear(place: Vec2, texel: impl Fn(i64, i64) -> f64) -> f64 {
    // Snaps to a texel's centre if only the last bits of a 64-bit float miss it.
    let [x, y] = place.map(|c| match c - 0.5 {
        c if (c - c.round()).abs() < 1e-9 => c.round(),
        c => c,
    });
    let (left, top) = (x.floor() as i64, y.floor() as i64);
    let mix = |a: f64, b: f64, part: f64| a + part * (b - a);
    let row = |y: i64| mix(texel(left, y), texel(left + 1, y), x - x.floor());
    mix(row(top), row(top + 1), y - y.floor())
}
