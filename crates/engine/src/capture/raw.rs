//! Raw dumps: the numbers of a buffer as an engine's memory has them, with a layout from `capture.toml`.

use std::path::Path;

use frame::{Channel, ExrFile, MAX_EXR_BYTES, Samples, read_bounded};
use half::f16;
use serde::Deserialize;
use suite::{Error, SIDES};

use crate::files::refuse;

/// Names of the channels that a dump's components become.
const CHANNELS: [&str; 4] = ["R", "G", "B", "A"];

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
        match is_side(width) && is_side(height) && (1..=CHANNELS.len()).contains(components) {
            true => Ok(()),
            false => Err(format!(
                "{width}x{height} pixels of {components} components; allowed: {} to {} columns and rows, 1 to {} components",
                SIDES.start(),
                SIDES.end(),
                CHANNELS.len()
            )),
        }
    }

    /// Reads a dump, as a file with the channels R, G, B and A or the first of them.
    pub fn read(&self, path: &Path) -> Result<ExrFile, Error> {
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
        let numbers = bytes.chunks_exact(each).map(|own| match own {
            [low, high] => f16::from_le_bytes([*low, *high]).to_f32(),
            _ => f32::from_le_bytes(own.try_into().expect("four bytes")),
        });
        let numbers: Vec<f32> = numbers.collect();
        let mut rows: Vec<&[f32]> = numbers.chunks(row).collect();
        if self.first_row == Row::Bottom {
            rows.reverse();
        }
        let mut file = ExrFile::new(self.width, self.height);
        file.path = path.to_owned();
        for (at, name) in CHANNELS.iter().take(self.components).enumerate() {
            let own = (rows.iter()).flat_map(|row| row.iter().skip(at).step_by(self.components));
            file.channels.push(Channel {
                name: (*name).to_owned(),
                samples: Samples::F32(own.copied().collect()),
            });
        }
        Ok(file)
    }
}
