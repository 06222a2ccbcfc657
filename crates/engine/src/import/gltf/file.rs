//! A glTF file: its JSON, its buffers and the bytes of its images.

use std::path::{Component, Path, PathBuf};

use frame::read_bounded;
use measure::Error;
use scene::limits::{LARGEST_IMAGE_FILE, LARGEST_MESH_FILE};

use super::data_uri::{decode_data_uri, decode_percent};
use super::extensions::check_required;
use super::schema::{BufferView, Gltf};
use crate::files::{refusal, refuse};

/// Largest JSON, in bytes: keys and vertices are in buffers.
const LARGEST_JSON: usize = 67_108_864;

/// First bytes of a binary glTF file.
const MAGIC: &[u8] = b"glTF";

/// A file that has been read, and the buffers that it names.
#[derive(Debug)]
pub struct File {
    pub path: PathBuf,
    pub json: Gltf,
    buffers: Vec<Vec<u8>>,
}

impl File {
    /// Reads a `.gltf` or `.glb` file with its buffers.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let bytes = read_bounded(path, LARGEST_MESH_FILE)?;
        let chunks = split(&bytes).map_err(|reason| refusal(path, reason))?;
        if chunks.json.len() > LARGEST_JSON {
            return refuse!(
                path,
                "its JSON has {} bytes; allowed: {LARGEST_JSON}; export vertices and keys into buffers",
                chunks.json.len()
            );
        }
        let json: Gltf = match serde_json::from_slice(chunks.json) {
            Ok(json) => json,
            Err(error) => return refuse!(path, "is no glTF 2.0 file: {error}; export it again"),
        };
        if !json.asset.version.starts_with("2.") {
            return refuse!(
                path,
                "asset.version is \"{}\"; allowed: 2.0; export it as glTF 2.0",
                json.asset.version
            );
        }
        check_required(&json, path).map_err(|reason| refusal(path, reason))?;
        let mut file = Self {
            path: path.to_owned(),
            json,
            buffers: Vec::new(),
        };
        let buffers = file.read_buffers(chunks.binary);
        file.buffers = buffers.map_err(|reason| refusal(path, reason))?;
        Ok(file)
    }

    /// Looks up an entry of a list; `list` names it, such as `nodes`.
    pub fn entry<'a, T>(list: &'a [T], name: &str, index: usize) -> Result<&'a T, String> {
        list.get(index).ok_or_else(|| {
            let count = list.len();
            format!("{name}[{index}] is named, but there are {count} {name}; export the file again")
        })
    }

    fn read_buffers(&self, binary: Option<&[u8]>) -> Result<Vec<Vec<u8>>, String> {
        let mut together = 0;
        let mut buffers = Vec::new();
        for (index, buffer) in self.json.buffers.iter().enumerate() {
            let place = format!("buffers[{index}]");
            let mut bytes = match (&buffer.uri, binary) {
                (Some(uri), _) => self.read_uri(uri, &place, LARGEST_MESH_FILE)?,
                (None, Some(binary)) if index == 0 => binary.to_vec(),
                (None, _) => {
                    return Err(format!(
                        "{place} has no uri, and the file holds no bytes for it; export the file again"
                    ));
                }
            };
            if bytes.len() < buffer.byte_length {
                return Err(format!(
                    "{place} has {} bytes; its byteLength says {}; the file is cut off, so copy or export it again",
                    bytes.len(),
                    buffer.byte_length
                ));
            }
            bytes.truncate(buffer.byte_length);
            together += bytes.len() as u64;
            if together > LARGEST_MESH_FILE {
                return Err(format!(
                    "its buffers have more than {LARGEST_MESH_FILE} bytes; export less at once"
                ));
            }
            buffers.push(bytes);
        }
        Ok(buffers)
    }

    /// Reads the bytes of a data URI, or of a file in the folder of this one.
    fn read_uri(&self, uri: &str, place: &str, limit: u64) -> Result<Vec<u8>, String> {
        if uri.starts_with("data:") {
            return decode_data_uri(uri).map_err(|reason| format!("{place}.uri {reason}"));
        }
        let name = decode_percent(uri);
        let mut parts = Path::new(&name).components();
        let is_below = parts.all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
        if name.is_empty() || !is_below || name.contains("://") || name.contains('\\') {
            return Err(format!(
                "{place}.uri is \"{name}\"; allowed: files in the folder of the glTF file; move it there, or export a .glb"
            ));
        }
        let path = self.path.with_file_name("").join(&name);
        read_bounded(&path, limit)
            .map_err(|error| format!("{place}: {error}; put the file there, or export a .glb"))
    }

    /// Returns a part of a buffer.
    pub fn view(&self, index: usize) -> Result<(&[u8], &BufferView), String> {
        let view = Self::entry(&self.json.buffer_views, "bufferViews", index)?;
        let buffer = Self::entry(&self.buffers, "buffers", view.buffer)?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let bytes = end.and_then(|end| buffer.get(view.byte_offset..end));
        let bytes = bytes.ok_or_else(|| {
            format!(
                "bufferViews[{index}] takes {} bytes from byte {} of a buffer of {}; export the file again",
                view.byte_length,
                view.byte_offset,
                buffer.len()
            )
        })?;
        Ok((bytes, view))
    }

    /// Returns the bytes of an image.
    pub fn image(&self, index: usize) -> Result<Vec<u8>, String> {
        let image = Self::entry(&self.json.images, "images", index)?;
        match (&image.uri, image.buffer_view) {
            (Some(uri), _) => self.read_uri(uri, &format!("images[{index}]"), LARGEST_IMAGE_FILE),
            (None, Some(view)) => Ok(self.view(view)?.0.to_vec()),
            (None, None) => Err(format!(
                "images[{index}] has neither a uri nor a bufferView; export the file again"
            )),
        }
    }
}

/// Parts of a file.
struct Chunks<'a> {
    json: &'a [u8],
    /// Bytes of the first buffer, if the file holds them.
    binary: Option<&'a [u8]>,
}

/// Splits a binary file into its chunks; other files are JSON as a whole.
fn split(bytes: &[u8]) -> Result<Chunks<'_>, String> {
    if !bytes.starts_with(MAGIC) {
        let json = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        if json.iter().find(|byte| !byte.is_ascii_whitespace()) != Some(&b'{') {
            return Err(
                "begins neither with glTF nor with {; allowed: glTF 2.0 files, .glb or .gltf"
                    .into(),
            );
        }
        return Ok(Chunks { json, binary: None });
    }
    let number = |at: usize| {
        let bytes = bytes.get(at..at + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    };
    let version = number(4).unwrap_or_default();
    if version != 2 {
        return Err(format!(
            "is binary glTF of version {version}; allowed: 2; export it again"
        ));
    }
    let mut chunks = Vec::new();
    let mut at = 12;
    while let (Some(length), Some(kind)) = (number(at), number(at + 4)) {
        let end = (at + 8).checked_add(length as usize);
        let Some(chunk) = end.and_then(|end| bytes.get(at + 8..end)) else {
            return Err(format!(
                "a chunk of {length} bytes begins at byte {at}, and the file has {}; the file is cut off, so copy or \
                 export it again",
                bytes.len()
            ));
        };
        chunks.push((kind, chunk));
        at += 8 + chunk.len();
    }
    let chunk = |name: &[u8; 4]| {
        let kind = u32::from_le_bytes(*name);
        chunks
            .iter()
            .find(|(found, _)| *found == kind)
            .map(|(_, chunk)| *chunk)
    };
    match chunk(b"JSON") {
        Some(json) => Ok(Chunks {
            json,
            binary: chunk(b"BIN\0"),
        }),
        None => Err("holds no JSON chunk; the file is cut off, so copy or export it again".into()),
    }
}
