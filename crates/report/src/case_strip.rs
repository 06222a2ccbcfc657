//! Pictures of a case side by side, from the PNG files that a run left.

use std::path::Path;

use frame::{Raster, read_png, write_png};
use store::RenderFile;
use suite::{Case, Error};

/// Pixels between two pictures.
const GAP: u32 = 2;

/// Display values in [0, 1].
pub type Picture = Raster<[f32; 3]>;

/// Writes truth, output and FLIP of a case side by side to the PNG file `out`; `folder` is that of its run.json.
///
/// # Errors
/// A picture of the case cannot be read, or the file cannot be written.
pub fn write_case_strip(case: &Case, folder: &Path, out: &Path) -> Result<(), Error> {
    let flip = read_png(&folder.join(&case.folder).join("flip.png"))?;
    let strip = [read_truth(folder, case)?, read_output(folder, case)?, flip];
    Ok(write_png(out, &tile(&strip, 3))?)
}

/// Reads the truth that a case is scored against.
pub fn read_truth(folder: &Path, case: &Case) -> Result<Picture, Error> {
    let name = RenderFile::Truth(case.alignment).picture();
    Ok(read_png(&folder.join(case.scene.folder()).join(name))?)
}

/// Reads the output of a case.
pub fn read_output(folder: &Path, case: &Case) -> Result<Picture, Error> {
    Ok(read_png(&folder.join(&case.folder).join("output.png"))?)
}

/// Places pictures of one size side by side, `columns` in a row, on white.
pub fn tile(pictures: &[Picture], columns: u32) -> Picture {
    let (width, height) = (pictures[0].width + GAP, pictures[0].height + GAP);
    let columns = columns.min(pictures.len() as u32);
    let rows = (pictures.len() as u32).div_ceil(columns);
    Raster::from_fn(columns * width - GAP, rows * height - GAP, |x, y| {
        let index = (y / height) * columns + x / width;
        let picture = pictures.get(index as usize);
        let inside = picture.filter(|it| x % width < it.width && y % height < it.height);
        inside.map_or([1.0; 3], |picture| *picture.at(x % width, y % height))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_stand_in_rows_with_gaps_between() {
        let pictures: Vec<Picture> = (0..3)
            .map(|index| Raster::filled(2, 1, [0.25 * index as f32; 3]))
            .collect();
        let sheet = tile(&pictures, 2);
        assert_eq!((sheet.width, sheet.height), (2 * 4 - 2, 2 * 3 - 2));
        assert_eq!(*sheet.at(0, 0), [0.0; 3]);
        assert_eq!(*sheet.at(2, 0), [1.0; 3]);
        assert_eq!(*sheet.at(4, 0), [0.25; 3]);
        assert_eq!(*sheet.at(1, 3), [0.5; 3]);
        assert_eq!(*sheet.at(5, 3), [1.0; 3], "no third column");
    }
}
