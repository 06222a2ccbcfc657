//! Pictures of the worst places of an audit.

use std::path::Path;

use frame::{FileError, Raster, Vectors, write_png};

/// Columns and rows around the worst place.
const SIDE: u32 = 48;
/// Pixels of the picture per pixel of the capture.
const ENLARGED: u32 = 5;
/// Pixels between the parts.
const GAP: u32 = 5;

/// Writes three parts side by side, around a place: the engine's velocity, the right one, and their difference. Grey is no motion;
/// more red is motion to the right, more green is motion downwards, and the longest right velocity of the picture is full colour.
pub fn write_audit_picture(
    path: &Path,
    found: &Vectors,
    right: &Vectors,
    [x, y]: [u32; 2],
) -> Result<(), FileError> {
    let speeds = right.pixels.iter().map(|[x, y]| x.hypot(*y));
    let fastest = speeds.fold(1.0, f32::max);
    let error = found.zip(right, |found, right| {
        [found[0] - right[0], found[1] - right[1]]
    });
    let parts = [found, right, &error];
    let [columns, rows] = [right.width, right.height].map(|side| side.min(SIDE));
    let left = x.saturating_sub(columns / 2).min(right.width - columns);
    let top = y.saturating_sub(rows / 2).min(right.height - rows);
    let part_width = columns * ENLARGED;
    let width = 3 * part_width + 2 * GAP;
    let picture = Raster::from_fn(width, rows * ENLARGED, |x, y| {
        let (part, inside) = (x / (part_width + GAP), x % (part_width + GAP));
        if inside >= part_width {
            return [1.0; 3];
        }
        let place = (left + inside / ENLARGED, top + y / ENLARGED);
        let [x, y] = *parts[part as usize].at(place.0, place.1);
        let shown = |part: f32| (0.5 + 0.5 * part / fastest).clamp(0.0, 1.0);
        [shown(x), shown(y), 0.5]
    });
    write_png(path, &picture)
}
