//! Pictures of the worst places of an audit.

use std::path::Path;

use frame::{FileError, Tile, Vectors, tile_pictures, write_png};

/// Columns and rows around the worst place.
const SIDE: u32 = 48;
/// Pixels of the picture per pixel of the capture.
const ENLARGED: u32 = 5;
/// Pixels between the parts.
const GAP: u32 = 5;

/// Writes three parts side by side, around a place: the engine's velocity, the right one, and their
/// difference. Grey is no motion; more red is motion to the right, more green is motion downwards,
/// and the longest right velocity of the picture is full colour.
pub fn write_audit_picture(
    path: &Path,
    buffer: &Vectors,
    right: &Vectors,
    place: [u32; 2],
) -> Result<(), FileError> {
    let speeds = right.pixels.iter().map(|[x, y]| x.hypot(*y));
    let fastest = speeds.fold(1.0, f32::max);
    let error = buffer.zip(right, |vector, right| {
        [vector[0] - right[0], vector[1] - right[1]]
    });
    let tile = Tile::around(place, SIDE, right.size());
    let shade = |part: f32| (0.5 + 0.5 * part / fastest).clamp(0.0, 1.0);
    let parts = [buffer, right, &error].map(|vectors| {
        let shown = vectors.part(tile).map(|[x, y]| [shade(*x), shade(*y), 0.5]);
        shown.enlarged(ENLARGED)
    });
    write_png(path, &tile_pictures(&parts, 3, GAP, [1.0; 3]))
}
