//! Raw dumps: the numbers of a buffer as an engine's memory has them, with a layout from
//! `capture.toml`.

use std::collections::BTreeSet;
use std::path::Path;

use frame::{Channel, ExrFile, MAX_EXR_BYTES, Samples, read_bounded};
use half::f16;
use measure::{Error, SIDES};
use serde::Deserialize;

use crate::files::refuse;

/// Names of the channels that a dump's components become.
const CHANNELS: [&str; 4] = ["R", "G", "B", "A"];

/// Smallest usual magnitude of a float in any unit, apart from 0.
const LEAST_FLOAT: f32 = 1e-6;
/// Largest usual magnitude of a number in any unit.
const LARGEST: f32 = 1e6;
/// Upper limit on different halves without a leading digit that are taken for byte-swapped round
/// numbers. More of them are small numbers.
const FEW: usize = 16;
/// Largest part of the numbers, apart from zeros, that may be unusual in a dump whose bytes are in
/// order.
const MOST_UNUSUAL: f64 = 0.01;
/// Smallest ratio that shows a big-endian dump: unusual numbers as they are, over those in the
/// other order of bytes.
const TELLING: usize = 10;

/// Layout of a dump: little-endian numbers, pixel by pixel and row by row, without padding.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawLayout {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Numbers per pixel.
    pub components: usize,
    /// Their type.
    #[serde(rename = "type")]
    pub number: Number,
    /// First row of the file.
    #[serde(default)]
    pub first_row: Row,
}

/// Type of a dump's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Number {
    F16,
    F32,
}

/// A row at an edge of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Row {
    #[default]
    Top,
    Bottom,
}

/// Reads a little-endian number.
fn read_number(bytes: &[u8]) -> f32 {
    match bytes {
        [low, high] => f16::from_le_bytes([*low, *high]).to_f32(),
        _ => f32::from_le_bytes(bytes.try_into().expect("four bytes")),
    }
}

/// Returns the smallest usual magnitude of a half: engines store small velocities without a leading
/// digit, and these differ.
fn least_half(numbers: &[f32]) -> f32 {
    let least = f16::MIN_POSITIVE.to_f32();
    let small = numbers
        .iter()
        .filter(|number| **number != 0.0 && number.abs() < least);
    let different: BTreeSet<u32> = small.map(|number| number.to_bits()).collect();
    if different.len() > FEW { 0.0 } else { least }
}

/// Finds an unusual number in a dump that makes sense only in the other order of its bytes; none in
/// any other dump. Colours below 0 are unusual, too.
fn find_big_endian(bytes: &[u8], each: usize, numbers: &[f32], is_color: bool) -> Option<f32> {
    let least = if each == 2 {
        least_half(numbers)
    } else {
        LEAST_FLOAT
    };
    let is_unusual = |number: &f32| {
        let is_negative = is_color && *number < 0.0;
        *number != 0.0 && (is_negative || !(least..=LARGEST).contains(&number.abs()))
    };
    let swapped = bytes.chunks_exact(each).map(|bytes| {
        let swapped: Vec<u8> = bytes.iter().rev().copied().collect();
        read_number(&swapped)
    });
    let unusual = numbers.iter().filter(|number| is_unusual(number)).count();
    let unusual_swapped = swapped.filter(is_unusual).count();
    let others = numbers.iter().filter(|number| **number != 0.0).count();
    let is_big =
        unusual as f64 > MOST_UNUSUAL * others as f64 && unusual > TELLING * unusual_swapped;
    numbers.iter().copied().find(is_unusual).filter(|_| is_big)
}

impl RawLayout {
    /// Refuses sizes that no capture has.
    pub fn check(&self) -> Result<(), String> {
        let Self {
            width,
            height,
            components,
            ..
        } = self;
        let is_side = |side| SIDES.contains(side);
        if is_side(width) && is_side(height) && (1..=CHANNELS.len()).contains(components) {
            Ok(())
        } else {
            Err(format!(
                "{width}x{height} pixels of {components} components; allowed: {} to {} columns and rows, 1 to {} components",
                SIDES.start(),
                SIDES.end(),
                CHANNELS.len()
            ))
        }
    }

    /// Reads the dump of a buffer, as a file with the channels R, G, B and A or the first of them.
    pub fn read(&self, path: &Path, buffer: &str) -> Result<ExrFile, Error> {
        let bytes = read_bounded(path, MAX_EXR_BYTES)?;
        let (each, word) = match self.number {
            Number::F16 => (2, "f16"),
            Number::F32 => (4, "f32"),
        };
        let row = self.width as usize * self.components;
        let needed = each * row * self.height as usize;
        if bytes.len() != needed {
            return refuse!(
                path,
                "has {} bytes; {}x{} pixels of {} {word} have {needed}: correct its layout in capture.toml, or save it without a \
                 header and padding",
                bytes.len(),
                self.width,
                self.height,
                self.components
            );
        }
        let numbers: Vec<f32> = bytes.chunks_exact(each).map(read_number).collect();
        if let Some(number) = find_big_endian(&bytes, each, &numbers, buffer == "color") {
            return refuse!(
                path,
                "holds {number:e} and other numbers out of order: its bytes seem to be big-endian; allowed: little-endian {word}; \
                 save them that way, or correct type in capture.toml"
            );
        }
        let mut rows: Vec<&[f32]> = numbers.chunks(row).collect();
        if self.first_row == Row::Bottom {
            rows.reverse();
        }
        let mut file = ExrFile::new(self.width, self.height);
        file.path = path.to_owned();
        for (at, name) in CHANNELS.iter().take(self.components).enumerate() {
            let values = (rows.iter()).flat_map(|row| row.iter().skip(at).step_by(self.components));
            file.channels.push(Channel {
                name: (*name).to_owned(),
                samples: Samples::F32(values.copied().collect()),
            });
        }
        Ok(file)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns whether dumps of numbers in either order are taken for big-endian ones.
    fn judge(is_color: bool, numbers: impl Fn(usize) -> f32) -> [[bool; 2]; 2] {
        let numbers: Vec<f32> = (0..4000).map(numbers).collect();
        let dumps = [
            numbers
                .iter()
                .flat_map(|number| f16::from_f32(*number).to_le_bytes())
                .collect::<Vec<u8>>(),
            numbers
                .iter()
                .flat_map(|number| number.to_le_bytes())
                .collect(),
        ];
        let is_big = |bytes: &[u8], each| {
            let numbers: Vec<f32> = bytes.chunks_exact(each).map(read_number).collect();
            find_big_endian(bytes, each, &numbers, is_color).is_some()
        };
        [0, 1].map(|at| {
            let (little, each) = (&dumps[at], [2, 4][at]);
            let big: Vec<u8> = little
                .chunks(each)
                .flat_map(|bytes| bytes.iter().rev().copied())
                .collect();
            [is_big(little, each), is_big(&big, each)]
        })
    }

    #[test]
    fn numbers_in_the_other_order_of_bytes_are_told_from_numbers_in_order() {
        let noise = |at: usize| (at as f32 * 12.9898).sin() * 43758.547 % 1.0;
        let told = [[false, true]; 2];
        assert_eq!(judge(false, noise), told, "velocities");
        assert_eq!(
            judge(true, |at| 0.18 + 0.1 * noise(at).abs()),
            told,
            "colours"
        );
        let few = |at: usize| [0.43, 0.61, 0.87][at % 3];
        assert_eq!(judge(true, few), told, "three colours");
        assert_eq!(
            judge(false, |at| 3.0 + 90.0 * noise(at).abs()),
            told,
            "metres"
        );
        assert_eq!(judge(true, |_| 0.5), told, "one grey");
        let sparse = |at: usize| if at < 40 { 0.25 } else { 0.0 };
        assert_eq!(judge(false, sparse), told, "few numbers");
        assert_eq!(judge(true, |_| 0.0), [[false; 2]; 2], "black");
        // Velocities of a slow camera in texture coordinates.
        let [halves, floats] = judge(false, |at| 1e-5 * noise(at));
        assert!(!halves[0] && !floats[0]);
    }
}
