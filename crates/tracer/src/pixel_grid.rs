//! Grids of pixels over a picture that are not its own: fewer pixels, or moved ones.

use frame::{Camera, Reprojection, Size};

/// A grid of pixels over a picture. Lengths in its renders are in pixels of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelGrid {
    /// Its size, guard band left out.
    pub size: Size,
    /// Distance by which every pixel looks to the right of its own place, and below it, in pixels
    /// of the grid: the jitter of a camera, or the place of a sample from the centre.
    pub offset: [f64; 2],
}

impl PixelGrid {
    /// Returns the picture's own pixels.
    pub fn of_picture(width: u32, height: u32) -> Self {
        Self {
            size: Size::new(width, height),
            offset: [0.0; 2],
        }
    }

    /// Returns the width and the height of a pixel of the grid, in pixels of a picture of `width` x
    /// `height`.
    pub(crate) fn step(&self, width: u32, height: u32) -> [f64; 2] {
        [
            f64::from(width) / f64::from(self.size.width),
            f64::from(height) / f64::from(self.size.height),
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

/// Converts a camera to pixels of `step` of its own. Its one focal length is for rows: columns have
/// the same if pixels stay square.
pub(crate) fn scale_camera(mut camera: Camera, step: [f64; 2]) -> Camera {
    camera.now.focal /= step[1];
    camera.before.focal /= step[1];
    camera
}
