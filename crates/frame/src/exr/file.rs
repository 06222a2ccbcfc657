//! Content of an OpenEXR file: named 32-bit channels and text attributes.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::path::PathBuf;
use std::str::FromStr;

use super::colors::{ColorMeaning, convert};
use crate::{FileError, Image, Plane, Raster, Size, Vectors};

/// Upper limit on channels that an error names.
const MOST_SHOWN: usize = 16;

/// The samples of one channel, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// 32-bit floats.
    F32(Vec<f32>),
    /// 32-bit unsigned integers: object ids.
    U32(Vec<u32>),
}

/// A named channel: `R`, `velocity.X`, `coverage.panel`.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Name, its layer first.
    pub name: String,
    /// One sample per pixel.
    pub samples: Samples,
}

/// The content of a single-part OpenEXR file.
#[derive(Clone, Debug, PartialEq)]
pub struct ExrFile {
    /// Path that it was read from; empty for a file not yet written.
    pub path: PathBuf,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Channels in any order; names are unique.
    pub channels: Vec<Channel>,
    /// Text attributes of the header.
    pub attributes: BTreeMap<String, String>,
    /// Reason why the pixels are not a whole picture of square pixels; `None` in every file of this
    /// program.
    pub odd_pixels: Option<String>,
    /// Meaning of the colours, by the file's attributes.
    pub meaning: ColorMeaning,
}

impl ExrFile {
    /// Makes a file without channels.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            path: PathBuf::new(),
            width,
            height,
            channels: Vec::new(),
            attributes: BTreeMap::new(),
            odd_pixels: None,
            meaning: ColorMeaning::default(),
        }
    }

    /// Returns its columns and rows.
    pub fn size(&self) -> Size {
        Size::new(self.width, self.height)
    }

    /// Sets a text attribute.
    pub fn set(&mut self, name: &str, value: impl Display) {
        self.attributes.insert(name.to_owned(), value.to_string());
    }

    /// Adds one channel of floats.
    pub fn push_plane(&mut self, name: &str, plane: &Plane) {
        self.push_owned_plane(name, plane.clone());
    }

    /// Adds one channel of floats without copying them.
    pub(crate) fn push_owned_plane(&mut self, name: &str, plane: Plane) {
        self.channels.push(Channel {
            name: name.to_owned(),
            samples: Samples::F32(plane.pixels),
        });
    }

    /// Adds `R G B`, in a named layer or at the top.
    pub fn push_color(&mut self, layer: &str, image: &Image) {
        for (component, name) in ["R", "G", "B"].into_iter().enumerate() {
            self.push_owned_plane(&in_layer(layer, name), image.map(|pixel| pixel[component]));
        }
    }

    /// Adds `X Y`, in a named layer.
    pub fn push_vectors(&mut self, layer: &str, vectors: &Vectors) {
        for (component, name) in ["X", "Y"].into_iter().enumerate() {
            self.push_owned_plane(
                &in_layer(layer, name),
                vectors.map(|vector| vector[component]),
            );
        }
    }

    /// Reads a text attribute as a value.
    pub fn get<T: FromStr>(&self, name: &str) -> Result<T, FileError> {
        let text = self.text(name)?;
        text.parse().map_err(|_| {
            self.foreign(format!(
                "attribute \"{name}\" holds \"{text}\", which cannot be read"
            ))
        })
    }

    /// Reads a text attribute as words.
    pub fn words(&self, name: &str) -> Result<Vec<String>, FileError> {
        Ok(self
            .text(name)?
            .split_whitespace()
            .map(str::to_owned)
            .collect())
    }

    /// Sets a text attribute to numbers.
    pub(crate) fn set_numbers(&mut self, name: &str, numbers: impl IntoIterator<Item = f64>) {
        let words: Vec<String> = numbers
            .into_iter()
            .map(|number| number.to_string())
            .collect();
        self.set(name, words.join(" "));
    }

    /// Reads a text attribute as finite numbers; none if it has another number of them.
    pub(crate) fn numbers<const N: usize>(
        &self,
        name: &str,
    ) -> Result<Option<[f64; N]>, FileError> {
        let words = self.words(name)?;
        let numbers = words
            .iter()
            .map(|word| word.parse().ok().filter(|n: &f64| n.is_finite()));
        let numbers: Option<Vec<f64>> = numbers.collect();
        Ok(numbers.and_then(|numbers| numbers.try_into().ok()))
    }

    /// Returns true if there is a channel of this name.
    pub fn has_channel(&self, name: &str) -> bool {
        self.channels.iter().any(|channel| channel.name == name)
    }

    /// Reads the samples per pixel of a truth, which files of older versions lack.
    pub fn samples_per_pixel(&self) -> Result<Plane, FileError> {
        if !self.has_channel("samples") {
            return Err(self.foreign(
                "holds no channel \"samples\", which older versions of shuttertruth did not write; make it anew with \
                 `shuttertruth truths render`"
                    .to_owned(),
            ));
        }
        self.plane("samples")
    }

    /// Reads a channel of floats.
    pub fn plane(&self, name: &str) -> Result<Plane, FileError> {
        Ok(self.raster(self.floats(name)?.to_vec()))
    }

    /// Takes a channel of floats out of the file, which leaves it without samples.
    pub(crate) fn take_plane(&mut self, name: &str) -> Result<Plane, FileError> {
        let channel = (self.channels.iter_mut()).find(|channel| channel.name == name);
        match channel.map(|channel| &mut channel.samples) {
            Some(Samples::F32(pixels)) => {
                let pixels = std::mem::take(pixels);
                Ok(self.raster(pixels))
            }
            _ => self.plane(name),
        }
    }

    /// Reads a channel of unsigned integers.
    pub fn u32s(&self, name: &str) -> Result<Raster<u32>, FileError> {
        match self.samples(name)? {
            Samples::U32(pixels) => Ok(self.raster(pixels.clone())),
            Samples::F32(_) => Err(self.foreign(format!(
                "channel \"{name}\" holds floats; 32-bit integers are needed"
            ))),
        }
    }

    /// Reads `R G B`, of a named layer or at the top, and converts them to Rec.709.
    ///
    /// # Errors
    /// The file lacks a channel, or its attributes say that the colours are not linear, or of an
    /// unknown kind.
    pub fn color(&self, layer: &str) -> Result<Image, FileError> {
        let color = self.join(["R", "G", "B"].map(|name| in_layer(layer, name)))?;
        self.expect_linear()?;
        let matrix = (self.meaning.to_rec_709()).map_err(|reason| self.foreign(reason))?;
        Ok(match matrix {
            None => color,
            Some(matrix) => color.map(|pixel| convert(&matrix, pixel)),
        })
    }

    /// Reads `X Y`, of a named layer.
    pub fn vectors(&self, layer: &str) -> Result<Vectors, FileError> {
        self.join(["X", "Y"].map(|name| in_layer(layer, name)))
    }

    /// Reads channels of floats as the components of one raster.
    pub(crate) fn join<const N: usize>(
        &self,
        names: [String; N],
    ) -> Result<Raster<[f32; N]>, FileError> {
        let mut pixels = vec![[0.0; N]; self.width as usize * self.height as usize];
        for (component, name) in names.iter().enumerate() {
            for (pixel, value) in pixels.iter_mut().zip(self.floats(name)?) {
                pixel[component] = *value;
            }
        }
        Ok(self.raster(pixels))
    }

    /// Reads what a file may have; none where it lacks a channel.
    pub fn optional<T>(
        &self,
        channel: &str,
        read: impl FnOnce() -> Result<T, FileError>,
    ) -> Result<Option<T>, FileError> {
        (self.has_channel(channel).then(read)).transpose()
    }

    /// Reads the object names, the background's first: the attribute "objects".
    pub(crate) fn objects(&self) -> Result<Vec<String>, FileError> {
        let names = self.words("objects")?;
        let mut known = BTreeSet::new();
        match names.iter().find(|name| !known.insert(*name)) {
            None if names.is_empty() => Err(self.foreign(
                "attribute \"objects\" is empty; it names the background and every object"
                    .to_owned(),
            )),
            None => Ok(names),
            Some(twin) => Err(self.foreign(format!(
                "attribute \"objects\" names \"{twin}\" twice; allowed: each name once"
            ))),
        }
    }

    /// Makes an error that names this file.
    pub(crate) fn foreign(&self, reason: String) -> FileError {
        FileError::foreign(&self.path, reason)
    }

    fn raster<T>(&self, pixels: Vec<T>) -> Raster<T> {
        Raster {
            width: self.width,
            height: self.height,
            pixels,
        }
    }

    fn text(&self, name: &str) -> Result<&str, FileError> {
        let text = self
            .attributes
            .get(name)
            .ok_or_else(|| self.foreign(format!("lacks the attribute \"{name}\"")))?;
        Ok(text)
    }

    fn floats(&self, name: &str) -> Result<&[f32], FileError> {
        match self.samples(name)? {
            Samples::F32(pixels) => Ok(pixels),
            Samples::U32(_) => Err(self.foreign(format!(
                "channel \"{name}\" holds integers; 32-bit floats are needed"
            ))),
        }
    }

    fn samples(&self, name: &str) -> Result<&Samples, FileError> {
        let channel = self.channels.iter().find(|channel| channel.name == name);
        let lacking = || {
            let reason = format!("lacks the channel \"{name}\"; {}", self.describe_channels());
            self.foreign(reason)
        };
        Ok(&channel.ok_or_else(lacking)?.samples)
    }

    /// Names the channels, or the first of many.
    pub(crate) fn describe_channels(&self) -> String {
        let names = self.channels.iter().map(|channel| channel.name.as_str());
        let shown: Vec<&str> = names.take(MOST_SHOWN).collect();
        let more = match self.channels.len() - shown.len() {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        format!("it has {}{more}", shown.join(", "))
    }
}

/// Puts a layer's name before a channel's.
pub(crate) fn in_layer(layer: &str, name: &str) -> String {
    if layer.is_empty() {
        name.to_owned()
    } else {
        format!("{layer}.{name}")
    }
}
