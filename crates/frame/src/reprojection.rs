//! Reprojection of still surfaces into the frame before.

use crate::FileError;
use crate::exr::ExrFile;

/// The camera's motion since the frame before, as it moves the pixels of a picture: all that an
/// engine knows without a velocity buffer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reprojection {
    /// Three rows that act on (x, y, 1, 1 / depth), in pixels from the picture's top left and
    /// metres. They give (x', y', 1) times a number, which is positive if the point was in front of
    /// the last frame's camera.
    pub rows: [[f64; 4]; 3],
}

impl Reprojection {
    /// Reprojection of a still camera.
    pub const STILL: Reprojection = Reprojection {
        rows: [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ],
    };

    /// Finds the place at which the frame before showed a still point; `None` behind the camera.
    pub fn place(&self, [x, y]: [f64; 2], depth: f64) -> Option<[f64; 2]> {
        let [x, y, common] = self
            .rows
            .map(|row| row[0] * x + row[1] * y + row[2] + row[3] / depth);
        (common > 0.0).then(|| [x / common, y / common])
    }

    /// Converts the matrix to pictures that begin `band` pixels further up and to the left.
    pub fn moved(&self, band: f64) -> Self {
        let [x, y, common] = self.rows.map(|row| {
            let [along, down, one, near] = row;
            [along, down, one - band * (along + down), near]
        });
        let further =
            |row: [f64; 4]| [0, 1, 2, 3].map(|column| row[column] + band * common[column]);
        Self {
            rows: [further(x), further(y), common],
        }
    }

    /// Sets the attribute `reprojection`.
    pub fn set(&self, file: &mut ExrFile) {
        file.set_numbers("reprojection", self.rows.as_flattened().iter().copied());
    }

    /// Reads the attribute `reprojection`.
    pub fn from_exr(file: &ExrFile) -> Result<Self, FileError> {
        let numbers: [f64; 12] = file.numbers("reprojection")?.ok_or_else(|| {
            file.foreign("attribute \"reprojection\" does not hold twelve numbers".to_owned())
        })?;
        Ok(Self {
            rows: [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| numbers[4 * row + column])),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_that_begin_elsewhere_show_the_same() {
        let turn = Reprojection {
            rows: [
                [1.1, 0.2, -3.0, 4.0],
                [-0.1, 0.9, 2.0, -1.0],
                [0.001, -0.002, 1.0, 0.3],
            ],
        };
        let [x, y] = turn.place([30.0, 20.0], 5.0).unwrap();
        let [x_moved, y_moved] = turn.moved(8.0).place([38.0, 28.0], 5.0).unwrap();
        assert!((x_moved - 8.0 - x).abs() < 1e-12 && (y_moved - 8.0 - y).abs() < 1e-12);
        let back = turn.moved(8.0).moved(-8.0);
        let rows = back
            .rows
            .as_flattened()
            .iter()
            .zip(turn.rows.as_flattened());
        for (value, expected) in rows {
            assert!((value - expected).abs() < 1e-12);
        }
    }
}
