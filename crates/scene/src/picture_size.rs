//! The allowed sizes of pictures.

use crate::limits::{LARGEST_SIDE, MAX_PIXELS};

/// A picture of no pixels, or of too many.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "size is {width}x{height}; allowed: 1 to {LARGEST_SIDE} pixels on either side, {MAX_PIXELS} in all"
)]
pub struct SizeError {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// Refuses an impossible size of a picture.
pub fn check_size(width: u32, height: u32) -> Result<(), SizeError> {
    let allowed = 1..=LARGEST_SIDE;
    let pixels = u64::from(width) * u64::from(height);
    if allowed.contains(&width) && allowed.contains(&height) && pixels <= MAX_PIXELS {
        Ok(())
    } else {
        Err(SizeError { width, height })
    }
}
