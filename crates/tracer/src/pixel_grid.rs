//! Grids of pixels that show a picture otherwise than its own pixels do: fewer of them, or moved.

use frame::{Camera, Reprojection};

/// A grid of pixels over a picture. Lengths in what is rendered on it are in pixels of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelGrid {
    /// Pixels per row and rows, guard band left out.
    pub size: [u32; 2],
    /// Distance by which every pixel looks to the right of its own place, and below it, in pixels of the grid: the jitter of a
    /// camera, or the place of a sample from the centre.
    pub offset: [f64; 2],
}

impl PixelGrid {
    /// Returns the picture's own pixels.
    pub fn of_picture(width: u32, height: u32) -> Self {
        Self {
            size: [width, height],
            offset: [0.0; 2],
        }
    }

    /// Returns the width and the height of a pixel of the grid, in pixels of a picture of `width` x `height`.
    pub(crate) fn step(&self, width: u32, height: u32) -> [f64; 2] {
        [
            f64::from(width) / f64::from(self.size[0]),
            f64::from(height) / f64::from(self.size[1]),
        ]
    }
}

/// Converts a reprojection to pixels of `step` of its own.
pub(crate) fn scale_reprojection(reprojection: Reprojection, step: [f64; 2]) -> Reprojection {
    let scaled = |row: [f64; 4]| [row[0] * step[0], row[1] * step[1], row[2], row[3]];
    let [x, y, common] = reprojection.rows.map(scaled);
    Reprojection {
        rows: [
            x.map(|part| part / step[0]),
            y.map(|part| part / step[1]),
            common,
        ],
    }
}

/// Converts a camera to pixels of `step` of its own. Its one focal length is that of the rows: columns have the same where pixels stay
/// square.
pub(crate) fn scale_camera(mut camera: Camera, step: [f64; 2]) -> Camera {
    camera.now.focal /= step[1];
    camera.before.focal /= step[1];
    camera
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coarser_grid_reprojects_the_same_points() {
        let turn = Reprojection {
            rows: [
                [1.1, 0.2, -3.0, 4.0],
                [-0.1, 0.9, 2.0, -1.0],
                [0.001, -0.002, 1.0, 0.3],
            ],
        };
        let step = [2.0, 1.5];
        let [x, y] = turn.place([30.0, 20.0], 5.0).unwrap();
        let coarse = scale_reprojection(turn, step);
        let [x_coarse, y_coarse] = coarse.place([15.0, 20.0 / 1.5], 5.0).unwrap();
        assert!((2.0 * x_coarse - x).abs() < 1e-12 && (1.5 * y_coarse - y).abs() < 1e-12);
    }
}
