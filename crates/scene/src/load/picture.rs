//! Picture files whose headers are checked before they are decoded.

use std::io::Cursor;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader};

/// Picture with only its header read.
pub(super) struct Header<'a> {
    decoder: Box<dyn ImageDecoder + 'a>,
    /// Pixels per row.
    pub(super) width: u32,
    /// Rows.
    pub(super) height: u32,
}

impl<'a> Header<'a> {
    /// Reads the header; the error is the decoder's.
    pub(super) fn read(bytes: &'a [u8], format: ImageFormat) -> Result<Self, String> {
        let reader = ImageReader::with_format(Cursor::new(bytes), format);
        let decoder = reader.into_decoder().map_err(|error| error.to_string())?;
        let (width, height) = decoder.dimensions();
        Ok(Self {
            decoder: Box::new(decoder),
            width,
            height,
        })
    }

    /// Number of texels.
    pub(super) fn texels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// Refuses an empty picture and one of more than `most` texels. The error follows the name of
    /// the picture.
    pub(super) fn check(&self, most: u64) -> Result<(), String> {
        check_size([self.width, self.height].map(u64::from), most)
    }

    /// Decodes the picture.
    pub(super) fn decode(self) -> Result<DynamicImage, String> {
        DynamicImage::from_decoder(self.decoder).map_err(|error| error.to_string())
    }
}

/// Refuses columns and rows of no texel, and of more than `most`. The error follows the name of the
/// picture.
pub(super) fn check_size([width, height]: [u64; 2], most: u64) -> Result<(), String> {
    let texels = width.saturating_mul(height);
    if (1..=most).contains(&texels) {
        return Ok(());
    }
    Err(format!(
        "is {width} x {height}, {texels} texels; allowed: 1 to {most}; scale it down"
    ))
}
