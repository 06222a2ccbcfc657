//! Pictures with headers that claim more than their files contain.

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use png::{BitDepth, ColorType, Encoder, chunk};
use serde::Deserialize;

/// Content of an OpenEXR header.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Claim {
    size: [i32; 2],
    /// First pixel of the data window.
    place: [i32; 2],
    /// Size of the display window; none if equal to the data window's.
    display: Option<[i32; 2]>,
    more_channels: usize,
    sampling: i32,
    /// Bits of the version: 0x800 is deep data.
    flags: u32,
    rest: Option<usize>,
    pub found: String,
}

impl Default for Claim {
    fn default() -> Self {
        Self {
            size: [64, 32],
            place: [0, 0],
            display: None,
            more_channels: 0,
            sampling: 1,
            flags: 0,
            rest: None,
            found: String::new(),
        }
    }
}

/// Reads a table of claims.
pub fn claims(table: &str) -> Vec<Claim> {
    let tables: toml::Table = include_str!("claims.toml").parse().unwrap();
    tables[table].clone().try_into().unwrap()
}

fn ints(all: &[i32]) -> Vec<u8> {
    all.iter().flat_map(|one| one.to_le_bytes()).collect()
}

impl Claim {
    /// Makes a file of uncompressed zeros, or only some bytes after the header.
    pub fn file(&self) -> Vec<u8> {
        let more = (0..self.more_channels).map(|at| format!("c{at:05}"));
        let mut names = ["B", "G", "R"].map(str::to_owned).to_vec();
        names.extend(more);
        let mut channels = Vec::new();
        for name in &names {
            channels.extend(name.bytes().chain([0]));
            channels.extend(ints(&[2, 0, self.sampling, self.sampling]));
        }
        channels.push(0);
        let window = |[x, y]: [i32; 2], [w, h]: [i32; 2]| ints(&[x, y, x + w - 1, y + h - 1]);
        let display = self.display.unwrap_or(self.size);
        let mut attributes = vec![
            ("channels", "chlist", channels),
            ("compression", "compression", vec![0]),
            ("dataWindow", "box2i", window(self.place, self.size)),
            ("displayWindow", "box2i", window([0, 0], display)),
            ("lineOrder", "lineOrder", vec![0]),
            ("pixelAspectRatio", "float", 1f32.to_le_bytes().to_vec()),
            ("screenWindowCenter", "v2f", vec![0; 8]),
            ("screenWindowWidth", "float", 1f32.to_le_bytes().to_vec()),
        ];
        if self.flags != 0 {
            attributes.extend([
                ("type", "string", b"deepscanline".to_vec()),
                ("version", "int", ints(&[1])),
                ("chunkCount", "int", ints(&[self.size[1]])),
                ("name", "string", b"part".to_vec()),
            ]);
        }
        let mut file = vec![0x76, 0x2f, 0x31, 0x01];
        file.extend((2 | self.flags).to_le_bytes());
        for (name, kind, value) in attributes {
            file.extend([name.as_bytes(), b"\0", kind.as_bytes(), b"\0"].concat());
            file.extend((value.len() as u32).to_le_bytes());
            file.extend(value);
        }
        file.push(0);
        let Some(rest) = self.rest else {
            return self.with_rows(file, 4 * names.len() * self.size[0] as usize);
        };
        file.resize(file.len() + rest, 0);
        file
    }

    /// Adds the offsets of all rows, and rows of this many bytes.
    fn with_rows(&self, mut file: Vec<u8>, row: usize) -> Vec<u8> {
        let first = file.len() + 8 * self.size[1] as usize;
        for y in 0..self.size[1] as usize {
            file.extend(((first + y * (8 + row)) as u64).to_le_bytes());
        }
        for y in 0..self.size[1] {
            file.extend(ints(&[self.place[1] + y, row as i32]));
            file.resize(file.len() + row, 0);
        }
        file
    }
}

/// Makes a PNG with this header and this many zeros in its rows, which compress to a few kilobytes.
pub fn png(width: u32, height: u32, [depth, kind]: [u8; 2], zeros: usize) -> Vec<u8> {
    let mut rows = ZlibEncoder::new(Vec::new(), Compression::best());
    rows.write_all(&vec![0; zeros]).unwrap();
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_depth(BitDepth::from_u8(depth).unwrap());
    encoder.set_color(ColorType::from_u8(kind).unwrap());
    let mut writer = encoder.write_header().unwrap();
    let written = writer.write_chunk(chunk::IDAT, &rows.finish().unwrap());
    written.unwrap();
    drop(writer);
    file
}
