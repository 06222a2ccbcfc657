//! Interval during which a shutter is open, and its alignment to the instant.

use serde::{Deserialize, Serialize};

use super::error::{LONGEST_EXPOSURE, SHORTEST_EXPOSURE, ShutterError};
use crate::FileError;
use crate::exr::ExrFile;
use crate::words::words;

/// The interval during which the shutter is open, in frames relative to the frame's instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shutter {
    /// Time at which the shutter opens, in frames.
    pub open: f64,
    /// Time at which it closes, in frames; later than `open`.
    pub close: f64,
}

impl Shutter {
    /// Makes a shutter that is open over `[open, close]`; refuses an interval that is empty,
    /// reversed or not finite.
    pub fn new(open: f64, close: f64) -> Result<Self, ShutterError> {
        if open.is_finite() && close.is_finite() && open < close {
            Ok(Self { open, close })
        } else {
            Err(ShutterError::Interval { open, close })
        }
    }

    /// Returns the length of the interval in frames; 1 is a shutter of 360 degrees.
    pub fn exposure(&self) -> f64 {
        self.close - self.open
    }

    /// Returns the time at `fraction` of the interval, 0 at the opening and 1 at the closing.
    pub fn at(&self, fraction: f64) -> f64 {
        self.open + fraction * (self.close - self.open)
    }
}

/// Position of the shutter interval relative to the frame's instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Alignment {
    /// `[-m, 0]`: the smear is behind the mover.
    Trailing,
    /// `[-m/2, m/2]`: the smear is on both sides.
    Centred,
    /// `[0, m]`: the smear is ahead of the mover.
    Leading,
}

impl Alignment {
    /// Makes a shutter of `exposure` frames with this alignment.
    pub fn shutter(self, exposure: f64) -> Result<Shutter, ShutterError> {
        if !exposure.is_finite() || exposure <= 0.0 {
            return Err(ShutterError::Exposure(exposure));
        }
        if !(SHORTEST_EXPOSURE..=LONGEST_EXPOSURE).contains(&exposure) {
            return Err(ShutterError::ExposureRange(exposure));
        }
        match self {
            Alignment::Trailing => Shutter::new(-exposure, 0.0),
            Alignment::Centred => Shutter::new(-exposure / 2.0, exposure / 2.0),
            Alignment::Leading => Shutter::new(0.0, exposure),
        }
    }
}

words! {
    Alignment read as "shutter alignment" {
        Trailing => "trailing",
        Centred => "centred",
        Leading => "leading",
    }
}

/// Sets the attributes of a shutter and its alignment.
pub(crate) fn set_shutter(file: &mut ExrFile, shutter: Shutter, alignment: Alignment) {
    file.set("shutter_open", shutter.open);
    file.set("shutter_close", shutter.close);
    file.set("alignment", alignment);
}

/// Reads the attributes of a shutter and its alignment.
pub(crate) fn get_shutter(file: &ExrFile) -> Result<(Shutter, Alignment), FileError> {
    let alignment: Alignment = file.get("alignment")?;
    let shutter = Shutter::new(file.get("shutter_open")?, file.get("shutter_close")?)
        .and_then(|shutter| alignment.shutter(shutter.exposure()).map(|_| shutter))
        .map_err(|error| file.foreign(error.to_string()))?;
    Ok((shutter, alignment))
}
