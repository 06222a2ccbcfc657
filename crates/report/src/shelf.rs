//! The numbers behind the pictures of one scene, each plane kept once however many cases show it.

use std::collections::HashMap;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use frame::{Image, Plane};
use rayon::prelude::*;

use super::packing::{Against, packed};
use super::precision::{Nature, Precision};

/// A plane is kept against an earlier one of its kind where at least this part of both is the same: filters leave alone what
/// does not move.
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
    /// The component before it.
    component: Option<usize>,
}

impl Shelf {
    /// The number of a plane.
    pub fn plane(&mut self, kind: &str, nature: Nature, plane: &Plane) -> usize {
        self.beside(None, kind, nature, plane)
    }

    /// The same of one that is another's next component.
    fn beside(
        &mut self,
        component: Option<usize>,
        kind: &str,
        nature: Nature,
        plane: &Plane,
    ) -> usize {
        let bits: Vec<u32> = plane.pixels.iter().map(|value| value.to_bits()).collect();
        if let Some(number) = self.known.get(&bits) {
            return *number;
        }
        let number = self.planes.len();
        self.planes.push(Kept {
            base: self.base(kind, &plane.pixels),
            component,
            values: plane.pixels.clone(),
            nature,
            kind: kind.to_owned(),
        });
        self.known.insert(bits, number);
        number
    }

    /// The numbers of an image's components.
    pub fn image(&mut self, image: &Image) -> Vec<usize> {
        let mut numbers = Vec::new();
        for (index, kind) in ["R", "G", "B"].into_iter().enumerate() {
            let before = numbers.last().copied();
            let plane = image.map(|pixel| pixel[index]);
            numbers.push(self.beside(before, kind, Nature::Number, &plane));
        }
        numbers
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

    /// Every plane as JSON: `{"bases": [null, 0, ..], "components": [null, ..], "planes": ["..", ..]}`: the numbers of the
    /// planes that each is kept against, and base64 of what [`packed`] makes of it.
    pub fn json(&self, precision: Precision) -> String {
        let planes: Vec<String> = (self.planes.par_iter())
            .map(|kept| format!("\"{}\"", STANDARD.encode(self.packed(kept, precision))))
            .collect();
        let numbers = |of: fn(&Kept) -> Option<usize>| {
            let numbers = self.planes.iter().map(of);
            let words: Vec<String> = numbers
                .map(|number| number.map_or("null".to_owned(), |number| number.to_string()))
                .collect();
            words.join(",")
        };
        format!(
            "{{\"bases\":[{}],\n\"components\":[{}],\n\"planes\":[{}]}}",
            numbers(|kept| kept.base),
            numbers(|kept| kept.component),
            planes.join(",\n")
        )
    }

    fn packed(&self, kept: &Kept, precision: Precision) -> Vec<u8> {
        let bits = |kept: &Kept| -> Vec<u32> {
            let values = kept.values.iter();
            let bits = values.map(|value| precision.bits(*value, kept.nature));
            bits.collect()
        };
        let of = |number: Option<usize>| number.map(|number| bits(&self.planes[number]));
        let (base, component) = (of(kept.base), of(kept.component));
        let against = Against {
            base: base.as_deref(),
            component: component.as_deref(),
        };
        packed(&bits(kept), against, precision)
    }
}

#[cfg(test)]
mod tests {
    use frame::Raster;
    use serde_json::{Value, json};

    use super::*;

    #[test]
    fn planes_are_kept_once_and_against_those_that_are_like_them() {
        let noise = |x: u32, y: u32| ((x * 7 + y * 13) % 31) as f32 / 9.0 - 1.0;
        let instant = Raster::from_fn(20, 10, |x, y| {
            [0.5, 0.6, 0.7].map(|part| part * noise(x, y))
        });
        // Half of it was left alone.
        let output = Raster::from_fn(20, 10, |x, y| match x < 10 {
            true => *instant.at(x, y),
            false => [1.0, 2.0, 3.0].map(|part| part + noise(x, y)),
        });
        let mut shelf = Shelf::default();
        let numbers = [&instant, &output, &instant].map(|image| shelf.image(image));
        assert_eq!(numbers, [vec![0, 1, 2], vec![3, 4, 5], vec![0, 1, 2]]);
        let error = instant.map(|pixel| pixel[0].abs() / 4.0);
        assert_eq!(shelf.plane("flip", Nature::Share, &error), 6);
        for precision in [Precision::Float, Precision::Half] {
            let json: Value = serde_json::from_str(&shelf.json(precision)).unwrap();
            assert_eq!(json["bases"], json!([null, null, null, 0, 1, 2, null]));
            assert_eq!(json["components"], json!([null, 0, 1, null, 3, 4, null]));
            assert_eq!(json["planes"].as_array().unwrap().len(), 7);
        }
    }
}
