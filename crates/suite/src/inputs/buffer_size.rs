//! Sizes of the velocity and depth buffers.

use frame::{Frame, Raster};

use crate::named;

named! {
    /// A size of the velocity and depth buffers, and the choice of the pixel that each texel stores.
    pub enum BufferSize {
        /// A texel for every pixel.
        Full = "full",
        /// A texel for every pixel: velocity and depth of the nearest surface among the nine pixels around.
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
    /// Returns the frame with velocity and depth as a filter reads them from such buffers: every pixel gets the texel that it lies in.
    /// Blocks count from the buffers' top left corner, guard band included; those at the right and at the bottom may be cut.
    pub(crate) fn apply(self, frame: Frame) -> Frame {
        let (width, height) = frame.size();
        let depth = |(x, y): (u32, u32)| *frame.depth.at(x, y);
        let taken = |x: u32, y: u32| match self {
            Self::Full => (x, y),
            Self::FullDilated => {
                let columns = x.saturating_sub(1)..(x + 2).min(width);
                let rows = y.saturating_sub(1)..(y + 2).min(height);
                nearest((x, y), pixels(columns, rows), depth)
            }
            Self::Half => first_of_block(x, y, 2),
            Self::Quarter => first_of_block(x, y, 4),
            Self::HalfDilated | Self::QuarterDilated => {
                let side = if self == Self::HalfDilated { 2 } else { 4 };
                let (left, top) = first_of_block(x, y, side);
                let columns = left..(left + side).min(width);
                let rows = top..(top + side).min(height);
                nearest((left, top), pixels(columns, rows), depth)
            }
        };
        let places = Raster::from_fn(width, height, taken);
        let velocity = places.map(|&(x, y)| *frame.velocity.at(x, y));
        let depth = places.map(|&place| depth(place));
        Frame {
            velocity,
            depth,
            ..frame
        }
    }
}

/// Finds the first pixel of the block that a pixel lies in.
fn first_of_block(x: u32, y: u32, side: u32) -> (u32, u32) {
    (x - x % side, y - y % side)
}

/// Lists pixels row by row.
fn pixels(
    columns: std::ops::Range<u32>,
    rows: std::ops::Range<u32>,
) -> impl Iterator<Item = (u32, u32)> {
    rows.flat_map(move |y| columns.clone().map(move |x| (x, y)))
}

/// Finds the nearest of some pixels. Another one must be nearer than `own` to take its place, and the first of equals stays.
fn nearest(
    own: (u32, u32),
    pixels: impl Iterator<Item = (u32, u32)>,
    depth: impl Fn((u32, u32)) -> f32,
) -> (u32, u32) {
    pixels.fold(own, |best, pixel| match depth(pixel) < depth(best) {
        true => pixel,
        false => best,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inputs::test_frame::test_frame;

    /// Makes a frame whose velocity names its pixel, with one near pixel.
    fn frame_with_near_pixel(near: (u32, u32)) -> Frame {
        let mut frame = test_frame(5, 3);
        frame.velocity = Raster::from_fn(5, 3, |x, y| [x as f32, y as f32]);
        frame.depth = Raster::from_fn(5, 3, |x, y| if (x, y) == near { 1.0 } else { 8.0 });
        frame
    }

    /// Lists the columns that a row of pixels took, and their depths.
    fn taken(size: BufferSize, near: (u32, u32), row: u32) -> [[f32; 3]; 5] {
        let frame = size.apply(frame_with_near_pixel(near));
        [0, 1, 2, 3, 4].map(|x| {
            let [column, line] = *frame.velocity.at(x, row);
            [column, line, *frame.depth.at(x, row)]
        })
    }

    #[test]
    fn blocks_store_their_first_pixel() {
        let expected = [0.0, 0.0, 2.0, 2.0, 4.0];
        // The near pixel is no first one, and gets lost.
        assert_eq!(
            taken(BufferSize::Half, (1, 1), 1),
            expected.map(|x| [x, 0.0, 8.0])
        );
        // The last row is a block of its own.
        assert_eq!(
            taken(BufferSize::Half, (1, 1), 2),
            expected.map(|x| [x, 2.0, 8.0])
        );
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
        assert_eq!(
            taken(BufferSize::Full, (3, 1), 1)[3],
            [3.0, 1.0, 1.0],
            "a full buffer changes nothing"
        );
    }
}
