//! Attributes of OpenEXR files as other programs write them.

use std::fs;
use std::path::Path;

/// Primaries of ACEScg: CIE xy of red, green, blue and white.
pub const ACES_CG: [f32; 8] = [0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767];
/// Primaries of Rec.709.
pub const REC_709: [f32; 8] = [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329];

/// Converts a colour to ACEScg, with Bradford's adaptation: the published matrix of ACES, "Rec.709
/// to AP1".
pub fn to_aces_cg([r, g, b]: [f32; 3]) -> [f32; 3] {
    [
        0.613_097 * r + 0.339_523 * g + 0.047_379 * b,
        0.070_194 * r + 0.916_354 * g + 0.013_452 * b,
        0.020_616 * r + 0.109_570 * g + 0.869_815 * b,
    ]
}

/// Returns the bytes of numbers in a header.
pub fn bytes_of(numbers: &[f32]) -> Vec<u8> {
    numbers
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect()
}

/// Writes an attribute into the header of a single-part file, in place of any of that name.
pub fn set_exr_attribute(path: &Path, name: &str, kind: &str, value: &[u8]) {
    const MAGIC_AND_VERSION: usize = 8;
    let file = fs::read(path).unwrap();
    let number = |at: usize, bytes: usize| {
        let mut number = [0; 8];
        number[..bytes].copy_from_slice(&file[at..at + bytes]);
        usize::try_from(u64::from_le_bytes(number)).unwrap()
    };
    let past_text = |at: usize| at + file[at..].iter().position(|byte| *byte == 0).unwrap() + 1;
    let mut header = file[..MAGIC_AND_VERSION].to_vec();
    let mut at = MAGIC_AND_VERSION;
    while file[at] != 0 {
        let size_at = past_text(past_text(at));
        let end = size_at + 4 + number(size_at, 4);
        if &file[at..past_text(at) - 1] != name.as_bytes() {
            header.extend(&file[at..end]);
        }
        at = end;
    }
    header.extend([name.as_bytes(), &[0], kind.as_bytes(), &[0]].concat());
    header.extend(u32::try_from(value.len()).unwrap().to_le_bytes());
    header.extend(value);
    header.push(0);
    // The table of chunks reaches from the header's end to the first chunk.
    let table = at + 1;
    let (chunks, grown) = (number(table, 8), header.len());
    for entry in (table..chunks).step_by(8) {
        let moved = number(entry, 8) + grown - table;
        header.extend((moved as u64).to_le_bytes());
    }
    header.extend(&file[chunks..]);
    fs::write(path, header).unwrap();
}
