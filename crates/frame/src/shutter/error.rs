//! Errors of shutters.

/// The shortest exposure, in frames.
pub const SHORTEST_EXPOSURE: f64 = 1e-9;
/// The longest exposure, in frames.
pub const LONGEST_EXPOSURE: f64 = 1e4;

/// An impossible shutter: what was asked for, and what is allowed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ShutterError {
    /// The interval is empty, reversed or not finite.
    #[error(
        "shutter closes at {close} before it opens at {open}; close must be later than open, both finite"
    )]
    Interval {
        /// Time at which it was to open.
        open: f64,
        /// Time at which it was to close.
        close: f64,
    },
    /// The exposure is not a positive, finite number of frames.
    #[error("exposure is {0} frames; allowed: above 0 and finite (0.5 frames = 180 degrees)")]
    Exposure(f64),
    /// The exposure is too short or too long to render.
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
    /// A table of efficiencies with too few values.
    #[error(
        "efficiency holds {0} values; allowed: 2 and more, at equal steps from the opening to the closing"
    )]
    Table(usize),
    /// An efficiency that is not a fraction.
    #[error("efficiency holds {0}; allowed: 0 to 1")]
    Efficiency(f64),
    /// A table of zeros.
    #[error("efficiency is 0 throughout, and no light passes; at least one value must be above 0")]
    Dark,
    /// A delay between rows that is not finite.
    #[error("rolling is {0} frames; allowed: finite numbers")]
    Rolling(f64),
}
