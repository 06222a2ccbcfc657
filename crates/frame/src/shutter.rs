//! When light is gathered.

use std::fmt;
use std::str::FromStr;

/// The shortest exposure, in frames.
pub const SHORTEST_EXPOSURE: f64 = 1e-9;
/// The longest exposure, in frames.
pub const LONGEST_EXPOSURE: f64 = 1e4;

/// The interval during which the shutter is open, in frames relative to the frame's instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shutter {
    /// When the shutter opens, in frames.
    pub open: f64,
    /// When it closes, in frames; later than `open`.
    pub close: f64,
}

/// A shutter that cannot be: what was asked for, and what is allowed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ShutterError {
    /// The interval is empty, reversed or not finite.
    #[error(
        "shutter closes at {close} before it opens at {open}; close must be later than open, both finite"
    )]
    Interval {
        /// When it was to open.
        open: f64,
        /// When it was to close.
        close: f64,
    },
    /// The exposure is not a positive, finite number of frames.
    #[error("exposure is {0} frames; allowed: above 0 and finite (0.5 frames = 180 degrees)")]
    Exposure(f64),
    /// The exposure is shorter or longer than anything can be rendered.
    #[error(
        "exposure is {0:e} frames; allowed: {SHORTEST_EXPOSURE:e} to {LONGEST_EXPOSURE} (0.5 frames = 180 degrees)"
    )]
    ExposureRange(f64),
    /// Opening and closing take longer than the exposure, or less than nothing.
    #[error(
        "shutter rises during {rise} and falls during {fall} of the exposure; allowed: 0 and above, together at \
         most 1"
    )]
    Ramps {
        /// Part of the exposure that opening was to take.
        rise: f64,
        /// Part of the exposure that closing was to take.
        fall: f64,
    },
    /// A table of efficiencies with so few values.
    #[error(
        "efficiency holds {0} values; allowed: 2 and more, at equal steps from the opening to the closing"
    )]
    Table(usize),
    /// An efficiency that is no fraction.
    #[error("efficiency holds {0}; allowed: 0 to 1")]
    Efficiency(f64),
    /// A table of zeros.
    #[error("efficiency is 0 throughout, and no light passes; at least one value must be above 0")]
    Dark,
    /// A delay between rows that is not finite.
    #[error("rolling is {0} frames; allowed: finite numbers")]
    Rolling(f64),
}

impl Shutter {
    /// A shutter open over `[open, close]`; refuses an interval that is empty, reversed or not finite.
    pub fn new(open: f64, close: f64) -> Result<Self, ShutterError> {
        if open.is_finite() && close.is_finite() && open < close {
            Ok(Self { open, close })
        } else {
            Err(ShutterError::Interval { open, close })
        }
    }

    /// Length of the interval in frames; 1 is a shutter of 360 degrees.
    pub fn exposure(&self) -> f64 {
        self.close - self.open
    }

    /// The time at `fraction` of the interval, 0 at the opening and 1 at the closing.
    pub fn at(&self, fraction: f64) -> f64 {
        self.open + fraction * (self.close - self.open)
    }
}

/// Where the shutter interval lies relative to the frame's instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Alignment {
    /// `[-m, 0]`: the smear lies behind the mover.
    Trailing,
    /// `[-m/2, m/2]`: the smear lies on both sides.
    Centred,
    /// `[0, m]`: the smear lies ahead of the mover.
    Leading,
}

impl Alignment {
    /// Every alignment.
    pub const ALL: [Alignment; 3] = [Alignment::Trailing, Alignment::Centred, Alignment::Leading];

    /// The word used in files, file names and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Alignment::Trailing => "trailing",
            Alignment::Centred => "centred",
            Alignment::Leading => "leading",
        }
    }

    /// The shutter of `exposure` frames that lies so.
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

impl fmt::Display for Alignment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Alignment {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL
            .into_iter()
            .find(|alignment| alignment.name() == text)
            .ok_or_else(|| {
                format!(
                    "shutter alignment \"{text}\" is unknown; allowed: trailing, centred, leading"
                )
            })
    }
}
