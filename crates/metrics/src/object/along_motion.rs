//! Rows of the truth along a translation.

use frame::Plane;

use crate::object::misplacement::{Misplacement, measure_misplacement};
use crate::object::mover::Mover;
use crate::object::row_mass::{InstantRows, RowMass};
use crate::object::rows::{Grid, Rows};

/// Largest difference between the rows of instant and shutter, in pixels of silhouette, gains and
/// losses together. Above it, growth would measure occlusion, not the filter.
const LARGEST_ROW_CHANGE: f64 = 0.25;

/// Facts about an object that translates within the picture.
pub struct AlongMotion {
    /// The rows that mattes are summed in.
    pub rows: Rows,
    /// The truth's matte in them.
    pub truth: Grid,
    /// The instant's matte in them.
    pub instant: InstantRows,
    /// Misplacement of the truth's first half.
    pub misplacement_noise: Option<Misplacement>,
    /// Excess of total variation of the truth's first half.
    pub variation_noise: f64,
    /// Noise plus the difference between the instant's rows and the shutter's; a reason if that is
    /// too large.
    pub mass_floor: Result<RowMass, String>,
}

impl AlongMotion {
    /// Makes the object's rows, or says why it has none.
    pub fn new(
        mover: &Mover,
        is_at_border: bool,
        instant: &Plane,
        truth: &Plane,
        half: &Plane,
    ) -> Result<Self, String> {
        let along = mover.translation()?;
        if is_at_border {
            return Err(BORDER.to_owned());
        }
        let length = mover.silhouette.lateral;
        if length <= 0.0 {
            return Err(NO_SILHOUETTE.to_owned());
        }
        let rows = Rows::new(along, truth.width, truth.height);
        let [instant, truth, half] = [instant, truth, half].map(|matte| rows.spread(matte));
        if truth.total_variation() <= 0.0 {
            return Err("is not seen while the shutter is open".to_owned());
        }
        let instant_rows = InstantRows::new(&instant);
        let change = RowMass::new(&instant, &truth, &instant_rows, length);
        let noise = RowMass::new(&half, &truth, &instant_rows, length);
        let changed = change.growth + change.gain + change.loss;
        let mass_floor = if changed <= LARGEST_ROW_CHANGE {
            Ok(RowMass {
                growth: noise.growth + change.growth,
                gain: noise.gain + change.gain,
                loss: noise.loss + change.loss,
            })
        } else {
            Err(format!(
                "rows do not keep their mass: occlusion or a change of shape alters the silhouette by {changed:.2} px \
                 between instant and shutter; growth and loss are measured up to {LARGEST_ROW_CHANGE} px"
            ))
        };
        Ok(Self {
            misplacement_noise: measure_misplacement(&half, &truth),
            variation_noise: half.total_variation() / truth.total_variation() - 1.0,
            mass_floor,
            rows,
            truth,
            instant: instant_rows,
        })
    }
}

/// Reason why an object at the border has no row scores.
pub const BORDER: &str = "touches the picture's border, where part of its smear is cut off";

/// Reason why an object without an outline has no scores per pixel of outline.
pub const NO_SILHOUETTE: &str = "shows no silhouette inside the picture";

/// Returns true if any of a matte lies on the outermost pixels.
pub fn touches_border(matte: &Plane) -> bool {
    let (right, bottom) = (matte.width - 1, matte.height - 1);
    let columns = (0..matte.width).flat_map(|x| [(x, 0), (x, bottom)]);
    let rows = (0..matte.height).flat_map(|y| [(0, y), (right, y)]);
    columns.chain(rows).any(|(x, y)| *matte.at(x, y) > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes a picture with ten rows of `length` pixels.
    fn bar(length: f32) -> Plane {
        Plane::from_fn(40, 20, |x, y| {
            let covered = (length - (x as f32 - 15.0)).clamp(0.0, 1.0);
            if (5..15).contains(&y) && x >= 15 {
                covered
            } else {
                0.0
            }
        })
    }

    /// Compares an object of 4 pixels with a truth that has other rows; both lateral sides have 20
    /// pixels.
    fn floor(truth: f32) -> Result<RowMass, String> {
        let silhouette = crate::object::mover::Silhouette {
            lateral: 20.0,
            across: 10.0,
        };
        let mover = Mover {
            displacement: [10.0, 0.0],
            deviation: 0.0,
            silhouette,
        };
        let truth = bar(truth);
        AlongMotion::new(&mover, false, &bar(4.0), &truth, &truth)?.mass_floor
    }

    #[test]
    fn rows_keep_their_mass_up_to_a_quarter_of_a_pixel_which_is_then_the_floor() {
        let near = |value: f64, expected: f64| (value - expected).abs() < 1e-3;
        // Ten rows that lack 0.4 px are 0.2 px of 20.
        let mass = floor(4.4).unwrap();
        assert!(near(mass.loss, 0.2) && near(mass.gain, 0.0), "{mass:?}");
        let mass = floor(3.6).unwrap();
        assert!(
            near(mass.loss, 0.0) && near(mass.gain + mass.growth, 0.2),
            "{mass:?}"
        );
        assert!(mass.gain > 0.19, "{mass:?}");
        let reason = floor(4.6).unwrap_err();
        assert!(
            reason.contains("alters the silhouette by 0.30 px"),
            "{reason}"
        );
    }

    #[test]
    fn a_trace_at_the_border_touches_it() {
        let touches = |x: u32, y: u32| {
            touches_border(&Plane::from_fn(5, 4, |column, row| {
                if (column, row) == (x, y) { 0.01 } else { 0.0 }
            }))
        };
        for (x, y) in [(0, 2), (4, 1), (2, 0), (3, 3)] {
            assert!(touches(x, y), "{x}, {y}");
        }
        assert!(!touches(1, 1) && !touches(3, 2));
    }
}
