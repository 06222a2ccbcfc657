//! Sheets: pictures side by side.

use crate::{Image, Raster};

/// Places pictures of one size side by side, `columns` in a row, with gaps in a colour between
/// them.
pub fn tile_pictures(pictures: &[Image], columns: u32, gap: u32, color: [f32; 3]) -> Image {
    let (width, height) = (pictures[0].width + gap, pictures[0].height + gap);
    let columns = columns.min(pictures.len() as u32);
    let rows = (pictures.len() as u32).div_ceil(columns);
    Raster::from_fn(columns * width - gap, rows * height - gap, |x, y| {
        let index = (y / height) * columns + x / width;
        let picture = pictures.get(index as usize);
        let inside =
            picture.filter(|picture| x % width < picture.width && y % height < picture.height);
        inside.map_or(color, |picture| *picture.at(x % width, y % height))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_stand_in_rows_with_gaps_between() {
        let pictures: Vec<Image> = (0..3)
            .map(|index| Raster::filled(2, 1, [0.25 * index as f32; 3]))
            .collect();
        let sheet = tile_pictures(&pictures, 2, 2, [1.0; 3]);
        assert_eq!((sheet.width, sheet.height), (2 * 4 - 2, 2 * 3 - 2));
        assert_eq!(*sheet.at(0, 0), [0.0; 3]);
        assert_eq!(*sheet.at(2, 0), [1.0; 3]);
        assert_eq!(*sheet.at(4, 0), [0.25; 3]);
        assert_eq!(*sheet.at(1, 3), [0.5; 3]);
        assert_eq!(*sheet.at(5, 3), [1.0; 3], "no third column");
    }
}
