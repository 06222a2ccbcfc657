//! The shutter of a scene.toml.

use frame::{Efficiency, LONGEST_EXPOSURE, ShutterProfile};
use serde::Deserialize;

/// The shutter's efficiency and rolling.
#[derive(Deserialize)]
#[serde(try_from = "ShutterTable")]
pub(super) struct Shutter(pub(super) ShutterProfile);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ShutterTable {
    rise: Option<f64>,
    fall: Option<f64>,
    efficiency: Option<Vec<f64>>,
    rolling: Option<f64>,
}

impl TryFrom<ShutterTable> for Shutter {
    type Error = String;

    fn try_from(table: ShutterTable) -> Result<Self, Self::Error> {
        let efficiency = match (table.efficiency, table.rise, table.fall) {
            (None, None, None) => Efficiency::Box,
            (None, rise, fall) => Efficiency::Trapezoid {
                rise: rise.unwrap_or(0.0),
                fall: fall.unwrap_or(0.0),
            },
            (Some(values), None, None) => Efficiency::Table(values),
            (Some(_), ..) => {
                let reason =
                    "the shutter has both an efficiency and a rise or fall; give one or the other";
                return Err(reason.to_owned());
            }
        };
        let profile = ShutterProfile {
            efficiency,
            rolling: table.rolling.unwrap_or(0.0),
        };
        if profile.rolling.abs() > LONGEST_EXPOSURE {
            return Err(format!(
                "rolling is {} frames; allowed: -{LONGEST_EXPOSURE} to {LONGEST_EXPOSURE}",
                profile.rolling
            ));
        }
        profile.check().map_err(|error| error.to_string())?;
        Ok(Self(profile))
    }
}
