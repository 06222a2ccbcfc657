//! Writing of OpenEXR files.

use std::io::Cursor;
use std::path::Path;

use exr::meta::attribute::AttributeValue;
use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Layer, LayerAttributes,
    WritableImage,
};
use half::f16;
use half::slice::HalfFloatSliceExt;
use rayon::prelude::*;

use super::check::CHECKSUM;
use super::file::{ExrFile, Samples};
use super::header::to_exr;
use crate::FileError;
use crate::file::write_atomically;

/// Writes single-part, lossless OpenEXR under a temporary name and renames it: the path has the
/// whole file or its old content. A file of a `kind` gets a checksum of its content.
///
/// Run lengths make noise up to a third larger than deflate does, in a sixth to a fourteenth of its
/// time.
pub fn write_exr(path: &Path, file: &ExrFile) -> Result<(), FileError> {
    let quick = Encoding {
        compression: Compression::RLE,
        ..Encoding::SMALL_LOSSLESS
    };
    write_encoded(path, file.clone(), quick, FlatSamples::F32)
}

/// Writes as [`write_exr`] does, smaller (ZIP16) and slower: for files that are made once, or that
/// repeat themselves. A channel of floats that are all halves, such as a mask, is written as
/// halves.
pub fn write_small_exr(path: &Path, file: ExrFile) -> Result<(), FileError> {
    write_encoded(path, file, Encoding::SMALL_LOSSLESS, shorten)
}

/// Shortens floats to halves if that loses nothing: widened again, each has the same bits.
fn shorten(floats: Vec<f32>) -> FlatSamples {
    const CHUNK: usize = 1024;
    let mut halves = vec![f16::ZERO; floats.len()];
    let mut widened = [0.0; CHUNK];
    let is_lossless =
        (floats.chunks(CHUNK).zip(halves.chunks_mut(CHUNK))).all(|(floats, halves)| {
            let widened = &mut widened[..floats.len()];
            halves.convert_from_f32_slice(floats);
            halves.convert_to_f32_slice(widened);
            (floats.iter().zip(widened))
                .all(|(float, widened)| float.to_bits() == widened.to_bits())
        });
    if is_lossless {
        FlatSamples::F16(halves)
    } else {
        FlatSamples::F32(floats)
    }
}

/// Writes floats rounded to halves (ZIP16), which is not lossless: for maps that people look at.
/// Larger values become the largest half.
pub fn write_half_exr(path: &Path, mut file: ExrFile) -> Result<(), FileError> {
    for channel in &mut file.channels {
        if let Samples::F32(samples) = &mut channel.samples {
            for value in samples {
                *value = round_to_half(*value).to_f32();
            }
        }
    }
    write_encoded(path, file, Encoding::SMALL_LOSSLESS, |samples| {
        FlatSamples::F16(samples.into_iter().map(round_to_half).collect())
    })
}

fn round_to_half(value: f32) -> f16 {
    f16::from_f32(value.clamp(f16::MIN.to_f32(), f16::MAX.to_f32()))
}

/// Encodes floats as `floats` does, and writes the file.
fn write_encoded(
    path: &Path,
    file: ExrFile,
    encoding: Encoding,
    floats: fn(Vec<f32>) -> FlatSamples,
) -> Result<(), FileError> {
    let pixels = file.width as usize * file.height as usize;
    // No checksum for files handed to other programs, which may change them.
    let checksum = (file.attributes.contains_key("kind"))
        .then(|| (CHECKSUM.to_owned(), file.compute_checksum()));
    let channels = file.channels.into_par_iter().map(|channel| {
        let samples = match channel.samples {
            Samples::F32(samples) => floats(samples),
            Samples::U32(samples) => FlatSamples::U32(samples),
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
        AnyChannels::sort(channels.collect::<Vec<_>>().into()),
    );
    let attributes = (file.attributes.into_iter()).filter(|(name, _)| name != CHECKSUM);
    for (name, value) in attributes.chain(checksum) {
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

/// Sorts the header's attributes by name: the encoder leaves them in random order, and equal
/// content must give equal bytes. The header keeps its length, so that every offset in the file
/// stays right.
///
/// An attribute is `name 0 type 0 size value`; an empty name ends the header (OpenEXR file layout,
/// "Header").
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
