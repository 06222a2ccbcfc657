//! Palettes of PNG files.

/// Upper limit on the colours of a palette.
pub const MAX_COLORS: usize = 256;

/// Refuses a PNG with a palette that is not a list of whole colours, at which the decoder would
/// panic. The error's text follows the file's name. The decoder reports all other faults.
pub fn check_png_palette(bytes: &[u8]) -> Result<(), String> {
    const SIGNATURE: usize = 8;
    /// Bytes of a chunk besides its content: length, name and checksum.
    const FRAME: usize = 12;
    let mut rest = bytes.get(SIGNATURE..).unwrap_or_default();
    while let [a, b, c, d, name @ ..] = rest {
        let length = u32::from_be_bytes([*a, *b, *c, *d]) as usize;
        if name.starts_with(b"PLTE")
            && (!length.is_multiple_of(3) || !(3..=3 * MAX_COLORS).contains(&length))
        {
            return Err(format!(
                "has a palette of {length} bytes; allowed: three for each of 1 to {MAX_COLORS} colours"
            ));
        }
        if name.starts_with(b"IDAT") {
            break;
        }
        rest = rest.get(FRAME.saturating_add(length)..).unwrap_or_default();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_palette(length: u8) -> Vec<u8> {
        let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\0oooo____\0\0\0".to_vec();
        bytes.push(length);
        bytes.extend(b"PLTE");
        bytes.extend(vec![0; usize::from(length) + 4]);
        bytes
    }

    #[test]
    fn a_palette_holds_whole_colors() {
        for length in [3, 6, 255] {
            assert_eq!(check_png_palette(&with_palette(length)), Ok(()));
        }
        for length in [0, 1, 5, 254] {
            let reason = check_png_palette(&with_palette(length)).unwrap_err();
            assert!(reason.contains(&format!("{length} bytes")), "{reason}");
        }
        let mut long = with_palette(3);
        long[22..24].copy_from_slice(&[4, 0]);
        assert!(check_png_palette(&long).is_err(), "1024 bytes");
    }

    #[test]
    fn what_is_cut_short_is_left_to_the_decoder() {
        let whole = with_palette(6);
        for end in 0..whole.len() {
            assert_eq!(check_png_palette(&whole[..end]), Ok(()));
        }
    }
}
