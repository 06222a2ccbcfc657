//! Errors of measuring.

/// Inputs that do not belong together, or that are not finite.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeasureError {
    /// Two rasters that should have one size.
    #[error("{what} is {found}, the truth is {truth}; render or filter both at one size")]
    Size {
        /// Which input.
        what: String,
        /// Its size.
        found: frame::Size,
        /// The truth's size.
        truth: frame::Size,
    },
    /// More pixels than can be measured.
    #[error("the truth is {truth}; at most {limit} pixels can be measured: render it smaller")]
    TooLarge {
        /// The truth's size.
        truth: frame::Size,
        /// Number of pixels that are allowed.
        limit: u64,
    },
    /// A picture without one matte per object.
    #[error(
        "{what} has {found} mattes, the truth has {allowed} objects with the background; give one matte per object"
    )]
    Mattes {
        /// Which input.
        what: String,
        /// Number of its mattes.
        found: usize,
        /// Number of the truth's objects.
        allowed: usize,
    },
    /// Infinity or NaN.
    #[error(
        "{what} holds {found} at pixel {at:?}; every value must be finite: look for a division by zero there"
    )]
    NotFinite {
        /// Which raster of which input.
        what: String,
        /// The value.
        found: f32,
        /// Column and row.
        at: (u32, u32),
    },
    /// Radiance too large to be squared.
    #[error(
        "the colour of {what} holds {found} at pixel {at:?}; at the scene's exposures at most {limit:e} can be compared: \
         lower the light, or [display] stops"
    )]
    TooBright {
        /// Which input.
        what: String,
        /// The value.
        found: f32,
        /// Column and row.
        at: (u32, u32),
        /// The largest radiance allowed, either sign.
        limit: f32,
    },
    /// Another exposure, other objects or another interval than the truth's.
    #[error(
        "{what} has {found}, the truth has {allowed}; render both from the same scene with the same shutter"
    )]
    Disagree {
        /// Which input, and which of its properties.
        what: &'static str,
        /// Value found.
        found: String,
        /// The truth's value.
        allowed: String,
    },
    /// HDR-FLIP exposures that form no range.
    #[error(
        "viewing exposure {stops}, HDR-FLIP exposures from {start} to {stop} in {count} steps; allowed: stops from -{most} to \
         {most}, start not above stop, 2 to 128 steps",
        most = frame::MAX_STOPS
    )]
    Exposures {
        /// Exposure of LDR comparisons, in stops.
        stops: f32,
        /// Darkest, in stops.
        start: f32,
        /// Brightest, in stops.
        stop: f32,
        /// Number of exposures.
        count: u32,
    },
}
