//! Reading of OpenEXR files, from any program.

use std::collections::HashSet;
use std::io::{BufReader, Cursor, Read, Seek};
use std::path::Path;

use exr::block::reader::Reader;
use exr::error::Error;
use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::Header;
use exr::prelude::{FlatSamples, ReadChannels, ReadLayers};
use half::slice::HalfFloatSliceExt;

use super::colors::ColorMeaning;
use super::file::{Channel, ExrFile, Samples};
use super::header::{check_header, describe_odd_pixels, from_exr};
use crate::FileError;
use crate::file::open_regular;

/// The bytes of a file, on disk or in memory: one type, so that the decoder is compiled once.
type Source<'a> = BufReader<Box<dyn ReadSeek + 'a>>;

trait ReadSeek: Read + Seek {}

impl<T: Read + Seek> ReadSeek for T {}

fn source<'a>(bytes: impl Read + Seek + 'a) -> Source<'a> {
    BufReader::new(Box::new(bytes))
}

/// Reads a single-part OpenEXR file; refuses one that is cut short, has several parts, or claims
/// more pixels, channels or bytes than [`MAX_EXR_BYTES`](crate::MAX_EXR_BYTES) and its neighbours
/// allow. Half floats are widened.
pub fn read_exr(path: &Path) -> Result<ExrFile, FileError> {
    let (handle, bytes) = open_regular(path, u64::MAX)?;
    decode(source(handle), bytes, path)
}

/// Reads an OpenEXR file as [`read_exr`] does, from a program that writes no checksum of the
/// content. Refuses chunks in a wrong place: the decoder checks what is in a chunk, and leaves
/// those pixels black that no chunk has.
pub(super) fn read_foreign_exr(path: &Path) -> Result<ExrFile, FileError> {
    let (handle, bytes) = open_regular(path, u64::MAX)?;
    check_places(source(handle), bytes, path)?;
    read_exr(path)
}

/// Decodes the bytes of a foreign OpenEXR file, with the same checks; `path` names it in errors.
pub fn decode_exr(bytes: &[u8], path: &Path) -> Result<ExrFile, FileError> {
    let size = bytes.len() as u64;
    check_places(source(Cursor::new(bytes)), size, path)?;
    decode(source(Cursor::new(bytes)), size, path)
}

/// Refuses two chunks in one place.
fn check_places(source: Source, bytes: u64, path: &Path) -> Result<(), FileError> {
    let chunks = read_header(source, bytes, path)?;
    let header = chunks.headers()[0].clone();
    let find_places = || {
        let chunks = chunks.filter_chunks(false, |_, _, _| true)?;
        let mut places = HashSet::new();
        for chunk in chunks {
            if !places.insert(header.get_block_data_indices(&chunk?.compressed_block)?) {
                return Err(Error::Invalid("two chunks have the same pixels".into()));
            }
        }
        Ok(())
    };
    find_places().map_err(|error| broken(path, error))
}

/// Reads the header of an OpenEXR file, and refuses disallowed ones.
fn read_header<'a>(
    source: Source<'a>,
    bytes: u64,
    path: &Path,
) -> Result<Reader<Source<'a>>, FileError> {
    let chunks = exr::block::read(source, false).map_err(|error| broken(path, error))?;
    check_header(chunks.headers(), bytes).map_err(|reason| FileError::foreign(path, reason))?;
    Ok(chunks)
}

/// Describes an error of the decoder.
fn broken(path: &Path, error: Error) -> FileError {
    match error {
        Error::NotSupported(reason) => {
            FileError::foreign(path, format!("cannot be read: {reason}"))
        }
        error => FileError::Broken {
            path: path.to_owned(),
            reason: error.to_string(),
        },
    }
}

fn decode(source: Source, bytes: u64, path: &Path) -> Result<ExrFile, FileError> {
    let broken = |error| broken(path, error);
    let chunks = read_header(source, bytes, path)?;
    let header = &chunks.headers()[0];
    let (odd_pixels, meaning) = (describe_odd_pixels(header), ColorMeaning::of(header));
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_chunks(chunks)
        .map_err(broken)?;
    let Some(layer) = image.layer_data.into_iter().next() else {
        return Err(FileError::foreign(path, "has no part".to_owned()));
    };
    let mut file = ExrFile::new(layer.size.width() as u32, layer.size.height() as u32);
    file.path = path.to_owned();
    file.odd_pixels = odd_pixels;
    file.meaning = meaning;
    for channel in layer.channel_data.list {
        let name = from_exr(&channel.name);
        let samples = match channel.sample_data {
            FlatSamples::F32(samples) => Samples::F32(samples),
            FlatSamples::U32(samples) => Samples::U32(samples),
            FlatSamples::F16(samples) => {
                let mut widened = vec![0.0; samples.len()];
                samples.convert_to_f32_slice(&mut widened);
                Samples::F32(widened)
            }
        };
        file.channels.push(Channel { name, samples });
    }
    let attributes = image.attributes.other.iter();
    set_texts(&mut file, attributes.chain(&layer.attributes.other));
    Ok(file)
}

/// What the headers of an OpenEXR file claim.
pub struct ExrClaims {
    /// Columns and rows of the first part.
    pub size: [u64; 2],
    /// Values in all channels of all parts.
    pub values: u64,
}

/// Reads what the bytes of an OpenEXR file claim to hold, without its pixels; `path` names it in
/// errors.
pub fn read_exr_claims(bytes: &[u8], path: &Path) -> Result<ExrClaims, FileError> {
    let refuse = |reason| FileError::Broken {
        path: path.to_owned(),
        reason,
    };
    let chunks = exr::block::read(source(Cursor::new(bytes)), false);
    let chunks = chunks.map_err(|error| refuse(error.to_string()))?;
    let headers = chunks.headers();
    let first = headers
        .first()
        .ok_or_else(|| refuse("it has no part".to_owned()))?;
    let size = |header: &Header| {
        [header.layer_size.width(), header.layer_size.height()].map(|side| side as u64)
    };
    let values = |header: &Header| {
        let [width, height] = size(header);
        (width * height).saturating_mul(header.channels.list.len() as u64)
    };
    Ok(ExrClaims {
        size: size(first),
        values: (headers.iter().map(values)).fold(0, u64::saturating_add),
    })
}

/// Reads size and text attributes of an OpenEXR file without its pixels, as a file without
/// channels; none if the file is missing or broken.
pub fn read_exr_header(path: &Path) -> Option<ExrFile> {
    let (handle, _) = open_regular(path, u64::MAX).ok()?;
    let chunks = exr::block::read(source(handle), false).ok()?;
    let header = chunks.headers().first()?;
    let size = header.layer_size;
    let mut file = ExrFile::new(size.width() as u32, size.height() as u32);
    file.path = path.to_owned();
    let attributes = header.own_attributes.other.iter();
    set_texts(&mut file, attributes.chain(&header.shared_attributes.other));
    Some(file)
}

fn set_texts<'a>(
    file: &mut ExrFile,
    attributes: impl Iterator<Item = (&'a Text, &'a AttributeValue)>,
) {
    for (name, value) in attributes {
        if let AttributeValue::Text(text) = value {
            file.attributes.insert(from_exr(name), from_exr(text));
        }
    }
}

/// Reads one text attribute of an OpenEXR file without its pixels; none if the file or the
/// attribute is missing or broken.
pub fn read_attribute(path: &Path, name: &str) -> Option<String> {
    read_exr_header(path)?.attributes.remove(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Raster, write_exr};

    #[test]
    fn a_header_claims_the_values_of_all_its_channels() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.exr");
        let mut file = ExrFile::new(5, 2);
        file.push_color("", &Raster::filled(5, 2, [0.5; 3]));
        file.push_plane("Z", &Raster::filled(5, 2, 1.0));
        write_exr(&path, &file).unwrap();
        let claims = read_exr_claims(&std::fs::read(&path).unwrap(), &path).unwrap();
        assert_eq!((claims.size, claims.values), ([5, 2], 40));
    }
}
