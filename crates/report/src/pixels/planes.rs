//! Planes of one scene's pictures, each stored once for all cases that show it.

use std::collections::HashMap;
use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use frame::{Image, Plane};
use half::f16;
use half::slice::{HalfBitsSliceExt, HalfFloatSliceExt};
use rayon::prelude::*;

/// Most differences that a browser adds up for one plane.
const LONGEST_CHAIN: usize = 4;
/// Step between the numbers that planes are compared by: enough to choose by, at a small part of
/// the work.
const STRIDE: usize = 61;

/// Planes as bits of halves, in the order of their addition. Equal planes are stored once.
///
/// A half has three significant digits. `report --exr` writes the floats themselves.
#[derive(Default)]
pub struct Planes {
    planes: Vec<Vec<u16>>,
    numbers: HashMap<Vec<u16>, usize>,
}

impl Planes {
    /// Adds a plane, unless an equal one is there, and returns its number.
    pub fn add(&mut self, plane: &Plane) -> usize {
        let mut bits = vec![0; plane.pixels.len()];
        (bits.reinterpret_cast_mut::<f16>()).convert_from_f32_slice(&plane.pixels);
        let next = self.planes.len();
        let number = *self.numbers.entry(bits.clone()).or_insert(next);
        if number == next {
            self.planes.push(bits);
        }
        number
    }

    /// Adds red, green and blue of an image, and returns their numbers.
    pub fn add_image(&mut self, image: &Image) -> Vec<usize> {
        let component = |index| image.map(|pixel| pixel[index]);
        [0, 1, 2].map(|index| self.add(&component(index))).to_vec()
    }

    /// Writes every plane as JSON: a list of texts. Each is the number of the plane that it is the
    /// difference from, if any, then a space, then the base64 of a zlib stream.
    pub fn json(&self) -> String {
        let references = self.choose_references();
        let texts: Vec<String> = (self.planes.par_iter().zip(references))
            .map(|(bits, alike)| {
                let whole = || compress(bits, &[&[0], &bits[..]].concat());
                let Some(Alike { number, is_equal }) = alike else {
                    return format!("\" {}\"", STANDARD.encode(whole()));
                };
                let difference = compress(bits, &self.planes[number]);
                let whole = if is_equal { None } else { Some(whole()) };
                match whole {
                    Some(whole) if whole.len() <= difference.len() => {
                        format!("\" {}\"", STANDARD.encode(whole))
                    }
                    _ => format!("\"{number} {}\"", STANDARD.encode(difference)),
                }
            })
            .collect();
        format!("[{}]", texts.join(",\n"))
    }

    /// Chooses for every plane the earlier one with the most equal numbers: filters leave most of a
    /// picture unchanged.
    fn choose_references(&self) -> Vec<Option<Alike>> {
        let samples: Vec<Vec<u16>> = (self.planes.iter())
            .map(|bits| bits.iter().copied().step_by(STRIDE).collect())
            .collect();
        let mut chains = vec![0; samples.len()];
        let mut references = Vec::new();
        for (number, sample) in samples.iter().enumerate() {
            let unequal = |other: usize| {
                let pairs = sample.iter().zip(&samples[other]);
                (pairs.filter(|(bits, other)| bits != other).count(), other)
            };
            let short = (0..number)
                .into_par_iter()
                .filter(|other| chains[*other] < LONGEST_CHAIN);
            let alike = short.map(unequal).min().map(|(unequal, other)| Alike {
                number: other,
                is_equal: 2 * unequal < sample.len(),
            });
            chains[number] = (alike.as_ref()).map_or(0, |alike| chains[alike.number] + 1);
            references.push(alike);
        }
        references
    }
}

/// An earlier plane that another is like.
struct Alike {
    number: usize,
    /// True if most numbers are equal, so that the difference from it takes the least bytes.
    is_equal: bool,
}

/// Compresses the difference of every number from another: first all lower bytes, then all higher
/// ones.
fn compress(bits: &[u16], others: &[u16]) -> Vec<u8> {
    let mut bytes = vec![0; 2 * bits.len()];
    let (low, high) = bytes.split_at_mut(bits.len());
    for index in 0..bits.len() {
        [low[index], high[index]] = bits[index].wrapping_sub(others[index]).to_le_bytes();
    }
    deflate(&bytes)
}

/// Makes a zlib stream.
pub fn deflate(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).expect("memory takes every byte");
    encoder.finish().expect("memory takes every byte")
}

#[cfg(test)]
mod tests {
    use frame::Raster;

    use super::*;

    #[test]
    fn planes_that_differ_little_are_stored_as_differences() {
        let mut planes = Planes::default();
        for changed in 0..7 {
            let plane = Raster::from_fn(40, 25, |x, y| {
                let at = 40 * y + x + u32::from(x < changed);
                (at.wrapping_mul(2_654_435_761) >> 20) as f32
            });
            planes.add(&plane);
        }
        let texts: Vec<String> = serde_json::from_str(&planes.json()).unwrap();
        assert!(texts[0].starts_with(' '), "a whole plane");
        assert!(!texts[1..].iter().any(|text| text.starts_with(' ')));
    }
}
