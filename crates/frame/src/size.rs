//! Sizes of pictures.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Columns and rows of a picture, in pixels. Files hold both as `[96, 54]`, people read `96x54`.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize,
)]
#[serde(from = "[u32; 2]", into = "[u32; 2]")]
pub struct Size {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Size {
    /// Makes the size of a picture.
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height }
    }

    /// Returns columns and rows, to be indexed by an axis.
    pub fn sides(self) -> [u32; 2] {
        self.into()
    }

    /// Makes each side from this size's.
    pub fn map(self, side: impl Fn(u32) -> u32) -> Self {
        Self::new(side(self.width), side(self.height))
    }

    /// Counts the pixels.
    pub fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

impl From<[u32; 2]> for Size {
    fn from([width, height]: [u32; 2]) -> Self {
        Self { width, height }
    }
}

impl From<(u32, u32)> for Size {
    fn from((width, height): (u32, u32)) -> Self {
        Self { width, height }
    }
}

impl From<Size> for [u32; 2] {
    fn from(Size { width, height }: Size) -> Self {
        [width, height]
    }
}

/// `96x54`
impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// Parses `96x54`; an error says nothing, since callers name what they allow.
impl FromStr for Size {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let side = |text: &str| text.parse().map_err(drop);
        let (width, height) = text.split_once('x').ok_or(())?;
        Ok(Self::new(side(width)?, side(height)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_read_as_it_is_written() {
        let size = Size::new(96, 54);
        assert_eq!(size.to_string(), "96x54");
        assert_eq!("96x54".parse(), Ok(size));
        for other in ["96", "96x", "x54", "96x54x1", "96 x 54", "-96x54", ""] {
            assert_eq!(other.parse::<Size>(), Err(()), "{other}");
        }
    }
}
