//! The numbers behind the pictures of one scene, each plane kept once however many cases show it.

use std::collections::HashMap;
use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use frame::{Image, Plane};
use rayon::prelude::*;

use super::precision::{Nature, Precision};

/// A plane is kept as its difference from an earlier one of its kind where at least this part of both is the same: filters
/// leave alone what does not move.
const LEAST_SHARED: f64 = 0.1;

/// Planes by the order in which they were first asked for. Equal planes are one.
#[derive(Default)]
pub struct Shelf {
    planes: Vec<Kept>,
    known: HashMap<Vec<u32>, usize>,
}

struct Kept {
    values: Vec<f32>,
    nature: Nature,
    /// Planes are alike within a kind: one component of colour, one error.
    kind: String,
    /// The earlier plane that it is kept against.
    base: Option<usize>,
}

impl Shelf {
    /// The number of a plane.
    pub fn plane(&mut self, kind: &str, nature: Nature, plane: &Plane) -> usize {
        let bits: Vec<u32> = plane.pixels.iter().map(|value| value.to_bits()).collect();
        if let Some(number) = self.known.get(&bits) {
            return *number;
        }
        let number = self.planes.len();
        self.planes.push(Kept {
            base: self.base(kind, &plane.pixels),
            values: plane.pixels.clone(),
            nature,
            kind: kind.to_owned(),
        });
        self.known.insert(bits, number);
        number
    }

    /// The numbers of an image's components.
    pub fn image(&mut self, image: &Image) -> Vec<usize> {
        let component = |index: usize| image.map(|pixel| pixel[index]);
        (["R", "G", "B"].iter().enumerate())
            .map(|(index, kind)| self.plane(kind, Nature::Number, &component(index)))
            .collect()
    }

    /// Of the planes of a kind, the first of those that share most with these values.
    fn base(&self, kind: &str, values: &[f32]) -> Option<usize> {
        let shared = |kept: &Kept| {
            let pairs = kept.values.iter().zip(values);
            pairs.filter(|(a, b)| a.to_bits() == b.to_bits()).count()
        };
        let mut best = (None, (LEAST_SHARED * values.len() as f64) as usize);
        for (number, kept) in self.planes.iter().enumerate() {
            if kept.kind == kind && kept.values.len() == values.len() && shared(kept) > best.1 {
                best = (Some(number), shared(kept));
            }
        }
        best.0
    }

    /// Every plane as JSON: `{"bases": [null, 0, ..], "planes": ["..", ..]}`, the latter base64 of zlib of bytes. These are
    /// the lowest bytes of all numbers, then the next, up to the highest. A number is kept as its bits exclusive-or those of
    /// the base, or without a base as the difference of its bits to those of the pixel before.
    pub fn json(&self, precision: Precision) -> String {
        let planes: Vec<String> = (self.planes.par_iter())
            .map(|kept| {
                format!(
                    "\"{}\"",
                    STANDARD.encode(deflated(&self.bytes(kept, precision)))
                )
            })
            .collect();
        let bases: Vec<String> = (self.planes.iter())
            .map(|kept| kept.base.map_or("null".to_owned(), |base| base.to_string()))
            .collect();
        format!(
            "{{\"bases\":[{}],\n\"planes\":[{}]}}",
            bases.join(","),
            planes.join(",\n")
        )
    }

    fn bytes(&self, kept: &Kept, precision: Precision) -> Vec<u8> {
        let bits = |kept: &Kept| -> Vec<u32> {
            let values = kept.values.iter();
            values
                .map(|value| precision.bits(*value, kept.nature))
                .collect()
        };
        let own = bits(kept);
        let differences: Vec<u32> = match kept.base {
            Some(base) => {
                let base = bits(&self.planes[base]);
                own.iter()
                    .zip(&base)
                    .map(|(own, base)| own ^ base)
                    .collect()
            }
            None => {
                let before = std::iter::once(&0).chain(&own);
                (own.iter().zip(before))
                    .map(|(own, before)| own.wrapping_sub(*before))
                    .collect()
            }
        };
        (0..precision.width())
            .flat_map(|byte| {
                differences
                    .iter()
                    .map(move |bits| (bits >> (8 * byte)) as u8)
            })
            .collect()
    }
}

fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).expect("memory takes every byte");
    encoder.finish().expect("memory takes every byte")
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::ZlibDecoder;
    use frame::Raster;
    use serde_json::Value;

    use super::*;

    /// What a reader of the JSON makes of a plane.
    fn read(shelf: &Value, number: usize, precision: Precision) -> Vec<u32> {
        let packed = STANDARD
            .decode(shelf["planes"][number].as_str().unwrap())
            .unwrap();
        let mut bytes = Vec::new();
        ZlibDecoder::new(&packed[..])
            .read_to_end(&mut bytes)
            .unwrap();
        let count = bytes.len() / precision.width();
        let mut bits: Vec<u32> = (0..count)
            .map(|at| {
                (0..precision.width())
                    .map(|byte| u32::from(bytes[byte * count + at]) << (8 * byte))
                    .sum()
            })
            .collect();
        let mask = u32::MAX >> (32 - 8 * precision.width());
        match shelf["bases"][number].as_u64() {
            Some(base) => {
                let base = read(shelf, base as usize, precision);
                bits.iter_mut()
                    .zip(base)
                    .for_each(|(own, base)| *own ^= base);
            }
            None => {
                for at in 1..count {
                    bits[at] = bits[at].wrapping_add(bits[at - 1]) & mask;
                }
            }
        }
        bits
    }

    #[test]
    fn planes_are_kept_once_and_come_back_bit_for_bit() {
        let noise = |x: u32, y: u32| ((x * 7 + y * 13) % 31) as f32 / 9.0 - 1.0;
        let instant = Raster::from_fn(20, 10, noise);
        // Half of it was left alone.
        let output = Raster::from_fn(20, 10, |x, y| match x < 10 {
            true => noise(x, y),
            false => -3.0 * noise(x, y) + 1e-3,
        });
        let mut shelf = Shelf::default();
        let planes = [&instant, &output, &instant];
        let numbers = planes.map(|plane| shelf.plane("R", Nature::Number, plane));
        assert_eq!(numbers, [0, 1, 0]);
        let error = shelf.plane(
            "flip",
            Nature::Share,
            &instant.map(|value| value.abs() / 4.0),
        );
        for precision in [Precision::Float, Precision::Half] {
            let json: Value = serde_json::from_str(&shelf.json(precision)).unwrap();
            assert_eq!(json["bases"], serde_json::json!([null, 0, null]));
            for (number, plane) in [(0, &instant), (1, &output)] {
                let kept = read(&json, number, precision);
                let due = plane.pixels.iter();
                let due: Vec<u32> = due
                    .map(|value| precision.bits(*value, Nature::Number))
                    .collect();
                assert!(kept == due, "{precision:?} {number}");
            }
            assert_eq!(read(&json, error, precision).len(), 200);
        }
    }
}
