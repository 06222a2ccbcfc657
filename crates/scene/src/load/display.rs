//! How pictures of a scene are shown, as a scene.toml says.

use serde::Deserialize;

use crate::{Display, FlipExposures};

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DisplayTable {
    stops: Option<Stops>,
    flip: Option<Flip>,
}

/// Exposure of pictures in stops.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "f32")]
struct Stops(f32);

impl TryFrom<f32> for Stops {
    type Error = String;

    fn try_from(stops: f32) -> Result<Self, Self::Error> {
        let display = Display {
            stops,
            ..Display::default()
        };
        display.check_stops()?;
        Ok(Self(stops))
    }
}

/// Exposures of HDR-FLIP.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "FlipTable")]
struct Flip(FlipExposures);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FlipTable {
    start: f32,
    stop: f32,
    count: u32,
}

impl TryFrom<FlipTable> for Flip {
    type Error = String;

    fn try_from(FlipTable { start, stop, count }: FlipTable) -> Result<Self, Self::Error> {
        let exposures = FlipExposures { start, stop, count };
        exposures.check()?;
        Ok(Self(exposures))
    }
}

impl From<&DisplayTable> for Display {
    fn from(table: &DisplayTable) -> Self {
        let default = Self::default();
        Self {
            stops: table.stops.map_or(default.stops, |Stops(stops)| stops),
            flip: table.flip.map_or(default.flip, |Flip(flip)| flip),
        }
    }
}
