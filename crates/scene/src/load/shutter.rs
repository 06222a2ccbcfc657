//! The shutter of a scene.toml.

use frame::{Efficiency, LONGEST_EXPOSURE, ShutterProfile};
use toml::Spanned;

use super::document::Document;
use super::error::SceneError;
use super::schema::ShutterTable;

/// Reads the shutter's efficiency and rolling.
pub(super) fn read_shutter(
    document: &Document,
    table: &Option<Spanned<ShutterTable>>,
) -> Result<ShutterProfile, SceneError> {
    let Some(table) = table else {
        return Ok(ShutterProfile::default());
    };
    let place = table.span();
    let table = table.get_ref();
    let efficiency = match (&table.efficiency, table.rise, table.fall) {
        (None, None, None) => Efficiency::Box,
        (None, rise, fall) => Efficiency::Trapezoid {
            rise: rise.unwrap_or(0.0),
            fall: fall.unwrap_or(0.0),
        },
        (Some(values), None, None) => Efficiency::Table(values.clone()),
        (Some(_), ..) => {
            let reason =
                "the shutter has both an efficiency and a rise or fall; give one or the other";
            return Err(document.error(place, reason));
        }
    };
    let profile = ShutterProfile {
        efficiency,
        rolling: table.rolling.unwrap_or(0.0),
    };
    if profile.rolling.abs() > LONGEST_EXPOSURE {
        let reason = format!(
            "rolling is {} frames; allowed: -{LONGEST_EXPOSURE} to {LONGEST_EXPOSURE}",
            profile.rolling
        );
        return Err(document.error(place, reason));
    }
    match profile.check() {
        Ok(()) => Ok(profile),
        Err(error) => Err(document.error(place, error.to_string())),
    }
}
