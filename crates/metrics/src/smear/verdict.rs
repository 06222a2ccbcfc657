//! What is wrong with a smear, in words, and the way out.

use frame::Alignment;

use super::{Smear, SmearDirection};

/// Shortest smear that counts as one, in exposures.
const SHORTEST: f64 = 0.15;
/// Ratio to the true length up to which a smear counts as right: half way to double, on a scale of
/// ratios.
const RIGHT: f64 = std::f64::consts::SQRT_2;
/// Most that an even smear leaves of the picture's change, and least weight that it has. The length
/// of another smear is no factor to correct an intensity by.
const EVEN: [f64; 2] = [0.15, 0.8];
/// Motion in pixels from which on the length is sure: many filters cut or round shorter ones.
const SURE_MOTION: f64 = 8.0;
/// Distance of a smear's middle from the instant, in its own lengths, from which on it lies on one
/// side: half way from none to the half of a one-sided smear.
const ONE_SIDED: f64 = 0.25;

/// Side of the instant that a smear lies on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Behind,
    Both,
    Ahead,
}

impl Smear {
    /// Returns its length in exposures; 1 is right.
    pub fn length(&self) -> f64 {
        self.close - self.open
    }

    fn side(&self) -> Side {
        let middle = 0.5 * (self.open + self.close) / self.length();
        if middle < -ONE_SIDED {
            Side::Behind
        } else if middle > ONE_SIDED {
            Side::Ahead
        } else {
            Side::Both
        }
    }

    /// Returns whether length, side and direction are those of a filter with this shutter.
    pub fn is_right(&self, alignment: Alignment) -> bool {
        self.fault(alignment).is_none()
    }

    /// Says what is wrong with the smear of a filter that declares this shutter, and the way out.
    pub fn verdict(&self, alignment: Alignment) -> String {
        let right = || {
            let side = match alignment {
                Alignment::Trailing => "behind the mover",
                Alignment::Centred => "on both sides",
                Alignment::Leading => "ahead of the mover",
            };
            format!("right: as long as the exposure, {side}")
        };
        self.fault(alignment).unwrap_or_else(right)
    }

    fn length_fault(&self) -> String {
        let length = self.length();
        if self.rest > EVEN[0] || self.weight < EVEN[1] {
            return format!("uneven, and most like an even smear of {length:.2} of the exposure");
        }
        let doubt = if self.motion < SURE_MOTION {
            format!(
                ", if a larger --size agrees: {:.0} px of motion are few",
                self.motion
            )
        } else {
            String::new()
        };
        let wrong = if length < 1.0 { "short" } else { "long" };
        format!(
            "too {wrong}: multiply the intensity by {:.2}{doubt}",
            1.0 / length
        )
    }

    fn fault(&self, alignment: Alignment) -> Option<String> {
        let length = self.length();
        if length < SHORTEST {
            return Some(
                "no smear: the filter changes nothing, or only moves the picture".to_owned(),
            );
        }
        match self.direction {
            SmearDirection::Along => {}
            SmearDirection::Flipped => {
                return Some(
                    "runs along the motion with up and down exchanged: change velocity_y"
                        .to_owned(),
                );
            }
            SmearDirection::Across => {
                return Some("runs across the motion: exchange x and y of the velocity".to_owned());
            }
        }
        let mut faults = Vec::new();
        faults.extend(side_fault(self.side(), alignment));
        if !(1.0 / RIGHT..=RIGHT).contains(&length) {
            faults.push(self.length_fault());
        }
        (!faults.is_empty()).then(|| faults.join("; "))
    }
}

/// Says why a smear lies on another side than the declared shutter.
fn side_fault(side: Side, alignment: Alignment) -> Option<String> {
    let place = match side {
        Side::Behind => "behind the mover",
        Side::Ahead => "ahead of the mover",
        Side::Both => "on both sides",
    };
    let due = match alignment {
        Alignment::Trailing => Side::Behind,
        Alignment::Centred => Side::Both,
        Alignment::Leading => Side::Ahead,
    };
    if side == due {
        return None;
    }
    let declared = match side {
        Side::Behind => Alignment::Trailing,
        Side::Both => Alignment::Centred,
        Side::Ahead => Alignment::Leading,
    };
    Some(if side != Side::Both && due != Side::Both {
        format!(
            "runs against the motion, {place}: change the sign of the velocity, or declare alignment = \"{declared}\""
        )
    } else if due == Side::Both {
        format!("one-sided, {place}: centre the taps, or declare alignment = \"{declared}\"")
    } else {
        format!("lies {place}: declare alignment = \"{declared}\"")
    })
}
