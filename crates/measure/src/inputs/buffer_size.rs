//! Sizes of the velocity and depth buffers.

use frame::{Frame, Plane, Raster, Size};

use crate::named;

named! {
    /// Size of the velocity and depth buffers, and the pixel that each texel stores.
    pub enum BufferSize {
        /// A texel for every pixel.
        Full = "full",
        /// A texel for every pixel: velocity and depth of the nearest surface among the nine pixels
        /// around.
        FullDilated = "full_dilated",
        /// A texel for every block of 2x2 pixels: its first pixel, top left.
        Half = "half",
        /// A texel for every block of 2x2 pixels: its nearest surface.
        HalfDilated = "half_dilated",
        /// A texel for every block of 4x4 pixels: its first pixel, top left.
        Quarter = "quarter",
        /// A texel for every block of 4x4 pixels: its nearest surface.
        QuarterDilated = "quarter_dilated",
    }
}

impl BufferSize {
    /// Returns the frame with velocity and depth as a filter reads them from such buffers: every
    /// pixel gets the texel that contains it. Blocks count from the buffers' top left corner,
    /// including the guard band; the last blocks at the right and the bottom may be cut.
    pub(crate) fn apply(self, frame: Frame) -> Frame {
        let (side, is_dilated) = match self {
            Self::Full | Self::FullDilated => (1, false),
            Self::Half => (2, false),
            Self::HalfDilated => (2, true),
            Self::Quarter => (4, false),
            Self::QuarterDilated => (4, true),
        };
        let Size { width, height } = frame.size();
        let places = Raster::from_fn(width, height, |x, y| {
            let first = [x - x % side, y - y % side];
            match self {
                Self::FullDilated => {
                    let begin = first.map(|at| at.saturating_sub(1));
                    nearest(&frame.depth, first, begin, [x + 2, y + 2])
                }
                _ if is_dilated => nearest(&frame.depth, first, first, first.map(|at| at + side)),
                _ => first,
            }
        });
        let velocity = places.map(|&[x, y]| *frame.velocity.at(x, y));
        let next = frame.velocity_next.as_ref();
        let velocity_next = next.map(|plane| places.map(|&[x, y]| *plane.at(x, y)));
        let z = frame.velocity_z.as_ref();
        let velocity_z = z.map(|plane| places.map(|&[x, y]| *plane.at(x, y)));
        let depth = places.map(|&[x, y]| *frame.depth.at(x, y));
        Frame {
            velocity,
            velocity_next,
            velocity_z,
            depth,
            ..frame
        }
    }
}

/// Finds the nearest surface of a block of pixels, row by row, up to `end`. Only a nearer one
/// replaces `first`, and the first of equals stays.
fn nearest(depth: &Plane, first: [u32; 2], begin: [u32; 2], end: [u32; 2]) -> [u32; 2] {
    let mut best = first;
    for y in begin[1]..end[1].min(depth.height) {
        for x in begin[0]..end[0].min(depth.width) {
            if depth.at(x, y) < depth.at(best[0], best[1]) {
                best = [x, y];
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inputs::test_frame::test_frame;

    /// Lists the pixels that a row of five reads, and their depths, in a frame of three rows with
    /// one near pixel.
    fn taken(size: BufferSize, near: (u32, u32), row: u32) -> [[f32; 3]; 5] {
        let mut frame = test_frame(5, 3);
        frame.velocity = Raster::from_fn(5, 3, |x, y| [x as f32, y as f32]);
        frame.depth = Raster::from_fn(5, 3, |x, y| if (x, y) == near { 1.0 } else { 8.0 });
        let frame = size.apply(frame);
        [0, 1, 2, 3, 4].map(|x| {
            let [column, line] = *frame.velocity.at(x, row);
            [column, line, *frame.depth.at(x, row)]
        })
    }

    #[test]
    fn blocks_store_their_first_pixel() {
        // The near pixel is not the first of its block, and gets lost; the last row is a block of
        // its own.
        for (row, first) in [(1, 0.0), (2, 2.0)] {
            let expected = [0.0, 0.0, 2.0, 2.0, 4.0].map(|x| [x, first, 8.0]);
            assert_eq!(taken(BufferSize::Half, (1, 1), row), expected);
        }
        let quarter = taken(BufferSize::Quarter, (0, 0), 2);
        assert_eq!(quarter[3], [0.0, 0.0, 1.0]);
        assert_eq!(quarter[4], [4.0, 0.0, 8.0]);
    }

    #[test]
    fn dilated_blocks_store_their_nearest_pixel() {
        let half = taken(BufferSize::HalfDilated, (3, 1), 0);
        assert_eq!(half[1], [0.0, 0.0, 8.0]);
        assert_eq!([half[2], half[3]], [[3.0, 1.0, 1.0]; 2]);
        let quarter = taken(BufferSize::QuarterDilated, (3, 1), 2);
        assert_eq!([quarter[0], quarter[3]], [[3.0, 1.0, 1.0]; 2]);
        assert_eq!(quarter[4], [4.0, 0.0, 8.0]);
    }

    #[test]
    fn full_dilation_looks_one_pixel_around_and_keeps_its_own_among_equals() {
        let full = taken(BufferSize::FullDilated, (3, 1), 0);
        assert_eq!(full[1], [1.0, 0.0, 8.0]);
        assert_eq!([full[2], full[3], full[4]], [[3.0, 1.0, 1.0]; 3]);
        let unchanged = taken(BufferSize::Full, (3, 1), 1);
        assert_eq!(unchanged[3..], [[3.0, 1.0, 1.0], [4.0, 1.0, 8.0]]);
    }
}
