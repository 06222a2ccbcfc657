//! Order of the rows of a picture in a texture.

use frame::Raster;

use crate::filter::Origin;

impl Origin {
    /// Puts the `count` rows of a picture in the order of a texture, and those of a texture in the
    /// order of a picture.
    pub(super) fn order_rows<T: Clone>(self, pixels: Vec<T>, count: u32) -> Vec<T> {
        match self {
            Self::TopLeft => pixels,
            Self::BottomLeft => {
                let length = pixels.len() / count as usize;
                let rows = pixels.chunks_exact(length).rev();
                rows.flatten().cloned().collect()
            }
        }
    }

    /// Turns what a texture holds into a picture with its first row at the top.
    pub(super) fn upright<T: Clone>(self, texels: Raster<T>) -> Raster<T> {
        let rows = texels.height;
        Raster {
            pixels: self.order_rows(texels.pixels, rows),
            ..texels
        }
    }
}
