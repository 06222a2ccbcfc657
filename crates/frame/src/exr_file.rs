//! OpenEXR files as named 32-bit channels and text attributes.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::fs::File;
use std::io::{BufReader, BufWriter, Cursor, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use exr::meta::attribute::AttributeValue;
use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Layer, LayerAttributes,
    ReadChannels, ReadLayers, WritableImage,
};

use crate::checksum::CHECKSUM;
use crate::exr_header::{check, padding};
use crate::exr_text::{from_exr, to_exr};
use crate::{FileError, Image, Plane, Raster};

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
    /// Where it was read from; empty for a file not yet written.
    pub path: PathBuf,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// In any order; names are unique.
    pub channels: Vec<Channel>,
    /// Text attributes of the header.
    pub attributes: BTreeMap<String, String>,
    /// In words, how the pixels lie in a display window of another place or size; none where both are one, as in every
    /// file of this program.
    pub padding: Option<String>,
}

impl ExrFile {
    /// A file without channels.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            path: PathBuf::new(),
            width,
            height,
            channels: Vec::new(),
            attributes: BTreeMap::new(),
            padding: None,
        }
    }

    /// Sets a text attribute.
    pub fn set(&mut self, name: &str, value: impl Display) {
        self.attributes.insert(name.to_owned(), value.to_string());
    }

    /// Adds one channel of floats.
    pub fn push_plane(&mut self, name: &str, plane: &Plane) {
        self.channels.push(Channel {
            name: name.to_owned(),
            samples: Samples::F32(plane.pixels.clone()),
        });
    }

    /// Adds `R G B`, in a named layer or at the top.
    pub fn push_color(&mut self, layer: &str, image: &Image) {
        for (component, name) in ["R", "G", "B"].into_iter().enumerate() {
            self.push_plane(&in_layer(layer, name), &image.map(|pixel| pixel[component]));
        }
    }

    /// A text attribute as a value.
    pub fn get<T: FromStr>(&self, name: &str) -> Result<T, FileError> {
        let text = self.text(name)?;
        text.parse().map_err(|_| {
            self.foreign(format!(
                "attribute \"{name}\" holds \"{text}\", which cannot be read"
            ))
        })
    }

    /// A text attribute as words.
    pub fn words(&self, name: &str) -> Result<Vec<String>, FileError> {
        Ok(self
            .text(name)?
            .split_whitespace()
            .map(str::to_owned)
            .collect())
    }

    /// A channel of floats.
    pub fn plane(&self, name: &str) -> Result<Plane, FileError> {
        match self.samples(name)? {
            Samples::F32(pixels) => Ok(Raster {
                width: self.width,
                height: self.height,
                pixels: pixels.clone(),
            }),
            Samples::U32(_) => Err(self.foreign(format!(
                "channel \"{name}\" holds integers; 32-bit floats are needed"
            ))),
        }
    }

    /// A channel of unsigned integers.
    pub fn u32s(&self, name: &str) -> Result<Raster<u32>, FileError> {
        match self.samples(name)? {
            Samples::U32(pixels) => Ok(Raster {
                width: self.width,
                height: self.height,
                pixels: pixels.clone(),
            }),
            Samples::F32(_) => Err(self.foreign(format!(
                "channel \"{name}\" holds floats; 32-bit integers are needed"
            ))),
        }
    }

    /// `R G B`, of a named layer or at the top.
    pub fn color(&self, layer: &str) -> Result<Image, FileError> {
        let [r, g, b] = ["R", "G", "B"].map(|name| self.plane(&in_layer(layer, name)));
        let (r, g, b) = (r?, g?, b?);
        let pixels = r
            .pixels
            .iter()
            .zip(&g.pixels)
            .zip(&b.pixels)
            .map(|((r, g), b)| [*r, *g, *b])
            .collect();
        Ok(Raster {
            width: self.width,
            height: self.height,
            pixels,
        })
    }

    /// Refuses a file whose `kind` attribute is another, or whose content is not what was written.
    pub fn expect_kind(&self, kind: &str) -> Result<(), FileError> {
        match self.attributes.get("kind").map(String::as_str) {
            Some(found) if found == kind => {
                self.expect_checksum()?;
                self.expect_no_padding()?;
                self.expect_finite()
            }
            Some(found) => Err(self.foreign(format!("is a {found}; a {kind} is needed"))),
            None => Err(self.foreign(format!(
                "was not written by shuttertruth (no attribute \"kind\"); a {kind} is needed: make one with \
                 `shuttertruth render`"
            ))),
        }
    }

    /// Refuses a file whose pixels are a part of its display window, or reach beyond it.
    pub fn expect_no_padding(&self) -> Result<(), FileError> {
        match &self.padding {
            None => Ok(()),
            Some(padding) => Err(self.foreign(format!(
                "{padding}; both must be one: write the picture without cropping or padding"
            ))),
        }
    }

    /// Refuses a channel that holds infinity or NaN.
    fn expect_finite(&self) -> Result<(), FileError> {
        for channel in &self.channels {
            let Samples::F32(samples) = &channel.samples else {
                continue;
            };
            if let Some(at) = samples.iter().position(|value| !value.is_finite()) {
                let (x, y) = (at % self.width as usize, at / self.width as usize);
                return Err(self.foreign(format!(
                    "channel \"{}\" holds {} at pixel ({x}, {y}); every value must be finite: render it again",
                    channel.name, samples[at]
                )));
            }
        }
        Ok(())
    }

    /// Object names, the background's first: the attribute "objects".
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

    /// An error that names this file.
    pub(crate) fn foreign(&self, reason: String) -> FileError {
        FileError::Foreign {
            path: self.path.clone(),
            reason,
        }
    }

    fn text(&self, name: &str) -> Result<&str, FileError> {
        let text = self
            .attributes
            .get(name)
            .ok_or_else(|| self.foreign(format!("lacks the attribute \"{name}\"")))?;
        Ok(text)
    }

    fn samples(&self, name: &str) -> Result<&Samples, FileError> {
        let channel = self.channels.iter().find(|channel| channel.name == name);
        Ok(&channel
            .ok_or_else(|| self.foreign(format!("lacks the channel \"{name}\"")))?
            .samples)
    }
}

pub(crate) fn in_layer(layer: &str, name: &str) -> String {
    if layer.is_empty() {
        name.to_owned()
    } else {
        format!("{layer}.{name}")
    }
}

/// Writes single-part, lossless OpenEXR under a temporary name and renames it: the path holds the whole file or what it held
/// before. A file that says its kind gets the checksum of its content.
///
/// Run lengths leave noise a sixth to a third larger than deflate would, and take a sixth to a fourteenth of its time, which
/// was a fifth of what measuring a picture takes.
pub fn write_exr(path: &Path, file: &ExrFile) -> Result<(), FileError> {
    write_encoded(
        path,
        file,
        Encoding {
            compression: Compression::RLE,
            ..Encoding::SMALL_LOSSLESS
        },
    )
}

/// The same, smaller (ZIP16) and much slower: for files that repeat themselves.
pub(crate) fn write_small_exr(path: &Path, file: &ExrFile) -> Result<(), FileError> {
    write_encoded(path, file, Encoding::SMALL_LOSSLESS)
}

fn write_encoded(path: &Path, file: &ExrFile, encoding: Encoding) -> Result<(), FileError> {
    let pixels = file.width as usize * file.height as usize;
    let channels = file.channels.iter().map(|channel| {
        let samples = match &channel.samples {
            Samples::F32(samples) => FlatSamples::F32(samples.clone()),
            Samples::U32(samples) => FlatSamples::U32(samples.clone()),
        };
        assert_eq!(
            samples.len(),
            pixels,
            "channel {} must have one sample per pixel",
            channel.name
        );
        AnyChannel::new(to_exr(&channel.name), samples)
    });
    let mut layer = Layer::new(
        (file.width as usize, file.height as usize),
        LayerAttributes::default(),
        encoding,
        AnyChannels::sort(channels.collect()),
    );
    let mut attributes = file.attributes.clone();
    // What other programs are handed is theirs to change.
    if attributes.contains_key("kind") {
        attributes.insert(CHECKSUM.to_owned(), file.checksum());
    }
    for (name, value) in attributes {
        layer
            .attributes
            .other
            .insert(to_exr(&name), AttributeValue::Text(to_exr(&value)));
    }
    let mut bytes = Cursor::new(Vec::new());
    exr::prelude::Image::from_layer(layer)
        .write()
        .to_buffered(&mut bytes)
        .map_err(|error| FileError::io(path, "encode", std::io::Error::other(error.to_string())))?;
    let mut bytes = bytes.into_inner();
    sort_attributes(&mut bytes);
    write_atomically(path, &bytes)
}

/// Puts the header's attributes in the order of their names: the encoder leaves them in a random one, and equal content
/// is to make equal bytes. The header keeps its length, so that every offset in the file stays right.
///
/// An attribute is `name 0 type 0 size value`; an empty name ends the header (OpenEXR file layout, "Header").
fn sort_attributes(bytes: &mut [u8]) {
    const MAGIC_AND_VERSION: usize = 8;
    let mut attributes = Vec::new();
    let mut at = MAGIC_AND_VERSION;
    while bytes[at] != 0 {
        let past_text = |from: usize| {
            let length = bytes[from..].iter().position(|byte| *byte == 0);
            from + length.expect("texts in a header end with 0") + 1
        };
        let size_at = past_text(past_text(at));
        let size = bytes[size_at..size_at + 4].try_into().expect("four bytes");
        let end = size_at + 4 + u32::from_le_bytes(size) as usize;
        attributes.push(bytes[at..end].to_vec());
        at = end;
    }
    attributes.sort();
    bytes[MAGIC_AND_VERSION..at].copy_from_slice(&attributes.concat());
}

/// Writes `bytes` under a temporary name in the same folder, then renames: the path holds all of them or what it held
/// before. Missing folders are made.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let fail = |error| FileError::io(path, "write", error);
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder).map_err(fail)?;
    let mut temporary = BufWriter::new(tempfile::NamedTempFile::new_in(folder).map_err(fail)?);
    temporary.write_all(bytes).map_err(fail)?;
    let temporary = temporary
        .into_inner()
        .map_err(|error| fail(error.into_error()))?;
    temporary.persist(path).map_err(|error| fail(error.error))?;
    Ok(())
}

/// Reads a single-part OpenEXR file; refuses one that is cut short, has several parts, or claims more pixels, channels or
/// bytes than [`MOST_EXR_BYTES`](crate::MOST_EXR_BYTES) and its neighbours allow. Half floats are widened.
pub fn read_exr(path: &Path) -> Result<ExrFile, FileError> {
    let (handle, bytes) = open_regular(path)?;
    let broken = |error: exr::error::Error| match error {
        exr::error::Error::NotSupported(reason) => {
            foreign(path, format!("cannot be read: {reason}"))
        }
        error => FileError::Broken {
            path: path.to_owned(),
            reason: error.to_string(),
        },
    };
    let chunks = exr::block::read(BufReader::new(handle), false).map_err(broken)?;
    check(chunks.headers(), bytes).map_err(|reason| foreign(path, reason))?;
    let padding = padding(&chunks.headers()[0]);
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_chunks(chunks)
        .map_err(broken)?;
    let Some(layer) = image.layer_data.into_iter().next() else {
        return Err(foreign(path, "has no part".to_owned()));
    };
    let mut file = ExrFile::new(layer.size.width() as u32, layer.size.height() as u32);
    file.path = path.to_owned();
    file.padding = padding;
    for channel in layer.channel_data.list {
        let name = from_exr(&channel.name);
        let samples = match channel.sample_data {
            FlatSamples::F32(samples) => Samples::F32(samples),
            FlatSamples::U32(samples) => Samples::U32(samples),
            FlatSamples::F16(samples) => {
                Samples::F32(samples.iter().map(|half| half.to_f32()).collect())
            }
        };
        file.channels.push(Channel { name, samples });
    }
    for (name, value) in image
        .attributes
        .other
        .into_iter()
        .chain(layer.attributes.other)
    {
        if let AttributeValue::Text(text) = value {
            file.attributes.insert(from_exr(&name), from_exr(&text));
        }
    }
    Ok(file)
}

/// The file and its size in bytes. A folder, a FIFO or a device is refused before it is opened, so that nothing blocks.
fn open_regular(path: &Path) -> Result<(File, u64), FileError> {
    let fail = |error| FileError::io(path, "read", error);
    if !std::fs::metadata(path).map_err(fail)?.is_file() {
        return Err(foreign(
            path,
            "is no regular file; name an OpenEXR file".to_owned(),
        ));
    }
    let file = File::open(path).map_err(fail)?;
    let bytes = file.metadata().map_err(fail)?.len();
    Ok((file, bytes))
}

fn foreign(path: &Path, reason: String) -> FileError {
    FileError::Foreign {
        path: path.to_owned(),
        reason,
    }
}
