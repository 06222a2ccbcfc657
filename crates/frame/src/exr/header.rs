//! The header of an OpenEXR file: its limits, checked before memory is allocated for pixels, and
//! its texts in UTF-8.

use exr::math::Vec2;
use exr::meta::attribute::Text;
use exr::meta::header::Header;

/// Upper limit on the columns and on the rows of an OpenEXR file.
pub const LARGEST_EXR_SIDE: usize = 16_384;
/// Upper limit on the channels of an OpenEXR file.
pub const MAX_EXR_CHANNELS: usize = 32_768;
/// Upper limit on the bytes that the samples of an OpenEXR file take in memory. A file that is
/// larger than this divided by [`LARGEST_EXR_RATIO`] may take more.
pub const MAX_EXR_BYTES: u64 = 1 << 30;
/// Upper limit on the ratio of a large OpenEXR file's samples to its size. Run lengths shrink
/// samples no further.
pub const LARGEST_EXR_RATIO: u64 = 64;

/// In memory all samples are 32-bit.
const BYTES_PER_SAMPLE: u64 = 4;

/// Refuses headers of several parts, of deep or subsampled data, and of more pixels, channels or
/// bytes than are allowed. `file_bytes` is the size of the file.
pub(crate) fn check_header(headers: &[Header], file_bytes: u64) -> Result<(), String> {
    let [header] = headers else {
        return Err(format!(
            "has {} parts; a single-part OpenEXR file is needed",
            headers.len()
        ));
    };
    if header.deep {
        return Err("holds deep data; one sample per pixel is needed".to_owned());
    }
    let (width, height) = (header.layer_size.width(), header.layer_size.height());
    if ![width, height]
        .iter()
        .all(|side| (1..=LARGEST_EXR_SIDE).contains(side))
    {
        return Err(format!(
            "claims {width}x{height} pixels; allowed: 1 to {LARGEST_EXR_SIDE} columns and rows"
        ));
    }
    let channels = &header.channels.list;
    if channels.len() > MAX_EXR_CHANNELS {
        return Err(format!(
            "claims {} channels; allowed: up to {MAX_EXR_CHANNELS}",
            channels.len()
        ));
    }
    if let Some(sparse) =
        (channels.iter()).find(|channel| (channel.sampling.0, channel.sampling.1) != (1, 1))
    {
        return Err(format!(
            "channel \"{}\" has one sample per {}x{} pixels; one per pixel is needed",
            from_exr(&sparse.name),
            sparse.sampling.0,
            sparse.sampling.1
        ));
    }
    let bytes = (width * height) as u64 * channels.len() as u64 * BYTES_PER_SAMPLE;
    let allowed = MAX_EXR_BYTES.max(file_bytes.saturating_mul(LARGEST_EXR_RATIO));
    if bytes > allowed {
        return Err(format!(
            "claims {width}x{height} pixels with {} channels, {bytes} bytes in memory, in a file of {file_bytes}; allowed: \
             up to {allowed} bytes",
            channels.len()
        ));
    }
    Ok(())
}

/// Largest difference of a pixel's width and height that is rounding.
const SQUARE: f32 = 1e-4;

/// Describes a display window that is not the data window, or pixels that are not square; `None`
/// for a picture as this program writes it.
pub(crate) fn describe_odd_pixels(header: &Header) -> Option<String> {
    let aspect = header.shared_attributes.pixel_aspect;
    let is_square = (aspect - 1.0).abs() <= SQUARE;
    if !is_square {
        return Some(format!(
            "its pixels are {aspect} times as wide as high (pixelAspectRatio); square ones are needed: write the picture without \
             an anamorphic squeeze"
        ));
    }
    let display = header.shared_attributes.display_window;
    let (place, size) = (header.own_attributes.layer_position, header.layer_size);
    if display.position == place && display.size == size {
        return None;
    }
    let window = |Vec2(width, height): Vec2<usize>, Vec2(x, y): Vec2<i32>| {
        format!("of {width}x{height} pixels from ({x}, {y})")
    };
    Some(format!(
        "its data window {} is not its display window {}; both must be one: write the picture without cropping or padding",
        window(size, place),
        window(display.size, display.position)
    ))
}

/// Encodes a text as UTF-8. The encoder itself knows only Latin-1, and panics beyond it.
pub(crate) fn to_exr(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}

/// Decodes UTF-8, or else the Latin-1 that older versions and other programs wrote.
pub(crate) fn from_exr(text: &Text) -> String {
    let utf_8 = std::str::from_utf8(text.as_slice());
    utf_8.map_or_else(|_| text.to_string(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn latin_1_is_still_read() {
        let latin_1 = Text::from_slice_unchecked(b"\xe9t\xe9");
        assert_eq!(from_exr(&latin_1), "\u{e9}t\u{e9}");
    }
}
