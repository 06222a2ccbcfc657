//! The catalogue of scenes inside the program, so that it needs no folder of scenes.

use std::io::Read;

use flate2::read::DeflateDecoder;
use scene::Bundle;

/// A file packed by the build script.
struct Packed {
    /// Path below the folder of scenes, with `/` as separator.
    path: &'static str,
    /// Bytes of the file itself.
    size: usize,
    /// Its bytes, deflated.
    deflated: &'static [u8],
}

// FILES: all packed files, by path.
include!(concat!(env!("OUT_DIR"), "/files.rs"));

/// The shipped scenes and their bounds.
pub static SCENES: Bundle = Bundle {
    name: "built-in",
    list: list_files,
    unpack: unpack_file,
};

fn list_files() -> Vec<&'static str> {
    FILES.iter().map(|file| file.path).collect()
}

fn unpack_file(path: &str) -> Option<Vec<u8>> {
    let file = FILES.iter().find(|file| file.path == path)?;
    let mut bytes = Vec::with_capacity(file.size);
    DeflateDecoder::new(file.deflated)
        .read_to_end(&mut bytes)
        .expect("the build script packed it whole");
    Some(bytes)
}
