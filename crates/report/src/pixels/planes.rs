//! Planes of one scene's pictures, each stored once however many cases show it.

use std::collections::HashMap;
use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use frame::{Image, Plane};
use half::f16;
use rayon::prelude::*;

/// Planes as bits of halves, by the order in which they were added. Equal planes are one.
///
/// A half has three digits that count. `report --exr` writes the floats themselves.
#[derive(Default)]
pub struct Planes {
    planes: Vec<Vec<u16>>,
    numbers: HashMap<Vec<u16>, usize>,
}

impl Planes {
    /// Adds a plane, unless an equal one is there, and returns its number.
    pub fn add(&mut self, plane: &Plane) -> usize {
        let values = plane.pixels.iter();
        let bits: Vec<u16> = values
            .map(|value| f16::from_f32(*value).to_bits())
            .collect();
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

    /// Writes every plane as JSON: a list of texts, each the base64 of a zlib stream.
    pub fn json(&self) -> String {
        let texts: Vec<String> = (self.planes.par_iter())
            .map(|bits| format!("\"{}\"", STANDARD.encode(compress(bits))))
            .collect();
        format!("[{}]", texts.join(",\n"))
    }
}

/// Compresses the difference of every number to the one before it: first all lower bytes, then all higher ones.
fn compress(bits: &[u16]) -> Vec<u8> {
    let before = std::iter::once(&0).chain(bits);
    let steps: Vec<u16> = (bits.iter().zip(before))
        .map(|(bits, before)| bits.wrapping_sub(*before))
        .collect();
    let low = steps.iter().map(|step| *step as u8);
    let high = steps.iter().map(|step| (*step >> 8) as u8);
    let bytes: Vec<u8> = low.chain(high).collect();
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(&bytes).expect("memory takes every byte");
    encoder.finish().expect("memory takes every byte")
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::ZlibDecoder;
    use frame::Raster;

    use super::*;

    #[test]
    fn a_plane_is_stored_once() {
        let instant = Raster::from_fn(20, 10, |x, y| {
            [0.5, 0.6, 0.7].map(|part| part * (x + y) as f32)
        });
        let output = instant.map(|pixel| pixel.map(|value| 1.0 + value));
        let mut planes = Planes::default();
        let numbers = [&instant, &output, &instant].map(|image| planes.add_image(image));
        assert_eq!(numbers, [vec![0, 1, 2], vec![3, 4, 5], vec![0, 1, 2]]);
        let json: Vec<String> = serde_json::from_str(&planes.json()).unwrap();
        assert_eq!(json.len(), 6);
    }

    #[test]
    fn compressed_numbers_come_back_bit_for_bit() {
        let bits: Vec<u16> = (0..1001_u32)
            .map(|at| (at.wrapping_mul(2_654_435_761) >> 13) as u16)
            .collect();
        let mut bytes = Vec::new();
        let stream = compress(&bits);
        ZlibDecoder::new(&stream[..])
            .read_to_end(&mut bytes)
            .unwrap();
        // As the page's script does it.
        let mut value = 0_u16;
        let read: Vec<u16> = (0..bits.len())
            .map(|at| {
                let step = u16::from_le_bytes([bytes[at], bytes[at + bits.len()]]);
                value = value.wrapping_add(step);
                value
            })
            .collect();
        assert_eq!(read, bits);
    }
}
