//! Motion and silhouette of one object of the frame.

use frame::{Frame, Plane, Raster};

use crate::object::nearest::find_nearest;

/// Least displacement over the shutter, in pixels; less counts as none, because it cannot be
/// measured.
const LEAST_DISPLACEMENT: f64 = 0.1;

/// Largest deviation of a translation: the root mean square by which its pixels' displacements
/// deviate from their mean, over that mean. A sphere that passes at five radii deviates by a
/// twentieth; a spinning disc by far more than the whole.
pub const LARGEST_DEVIATION: f64 = 0.1;

/// An object that is visible at the instant and moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Mover {
    /// Mean displacement over the shutter, in pixels; +x right, +y down.
    pub displacement: [f64; 2],
    /// Root mean square of the displacements' deviation from their mean, in pixels.
    pub deviation: f64,
    /// Outline of the object at the instant.
    pub silhouette: Silhouette,
}

/// Motion of an object's visible pixels over the exposure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Displacement {
    /// Mean, in pixels; +x right, +y down.
    pub mean: [f64; 2],
    /// Root mean square of the deviation from it, in pixels.
    pub deviation: f64,
}

impl Displacement {
    /// Measures object `id` of the frame. The error is the reason why it has none.
    pub fn new(frame: &Frame, id: u32) -> Result<Self, &'static str> {
        let seen = frame.object_id.pixels.iter().map(|object| *object == id);
        let vectors = displacements(frame, seen);
        if vectors.is_empty() {
            return Err("is not visible at the instant");
        }
        if !vectors.iter().any(is_moved) {
            return Err("does not move");
        }
        Ok(Self::of(&vectors))
    }

    /// Measures all pixels that move, of whatever object; none if no pixel does.
    pub fn of_all(frame: &Frame) -> Option<Self> {
        let vectors = displacements(frame, moving_pixels(frame));
        (!vectors.is_empty()).then(|| Self::of(&vectors))
    }

    fn of(vectors: &[[f64; 2]]) -> Self {
        let mean = mean(vectors);
        let squares = vectors
            .iter()
            .map(|d| length([d[0] - mean[0], d[1] - mean[1]]).powi(2));
        let deviation = (squares.sum::<f64>() / vectors.len() as f64).sqrt();
        Self { mean, deviation }
    }

    /// Returns whether all pixels go nearly as far, and in one direction.
    pub fn is_translation(&self) -> bool {
        self.deviation <= LARGEST_DEVIATION * length(self.mean)
    }
}

/// Says of every pixel whether it moves while the shutter is open.
pub(crate) fn moving_pixels(frame: &Frame) -> impl Iterator<Item = bool> {
    let pixels = frame.velocity.pixels.iter();
    pixels.map(|velocity| is_moved(&displacement(frame, velocity)))
}

/// Lists the displacements of chosen pixels over the exposure.
fn displacements(frame: &Frame, is_chosen: impl Iterator<Item = bool>) -> Vec<[f64; 2]> {
    let chosen = (frame.velocity.pixels.iter().zip(is_chosen)).filter(|(_, is_chosen)| *is_chosen);
    chosen
        .map(|(velocity, _)| displacement(frame, velocity))
        .collect()
}

fn displacement(frame: &Frame, velocity: &[f32; 2]) -> [f64; 2] {
    velocity.map(|component| f64::from(component) * frame.exposure)
}

fn is_moved(displacement: &[f64; 2]) -> bool {
    length(*displacement) >= LEAST_DISPLACEMENT
}

/// Unit vector along which the nearest visible pixel of an object moves, per pixel; zero if that
/// one does not move.
pub type Directions = Raster<[f64; 2]>;

/// Length of an object's outline, in pixels, each way of crossing it counted: the total variation
/// of its matte across and along the motion. For a convex object it is the width, twice for both
/// sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Silhouette {
    /// Length of both lateral sides together, measured along the motion.
    pub lateral: f64,
    /// Width across the motion: half the length of front and back.
    pub across: f64,
}

impl Mover {
    /// Measures object `id` of the frame, moving for the frame's exposure. Returns the directions
    /// separately: they take more memory than the rest of an object, and only its sides depend on
    /// them. The error is the reason why it has no matte scores.
    pub fn new(frame: &Frame, id: u32) -> Result<(Self, Directions), &'static str> {
        let Displacement { mean, deviation } = Displacement::new(frame, id)?;
        let seen = frame.object_id.map(|object| *object == id);
        let sources = find_nearest(&seen).ok_or("is not visible at the instant")?;
        let directions = sources.map(|[x, y]| unit(displacement(frame, frame.velocity.at(*x, *y))));
        let silhouette = Silhouette::new(&frame.coverage[id as usize], &directions);
        let mover = Self {
            displacement: mean,
            deviation,
            silhouette,
        };
        Ok((mover, directions))
    }

    /// Returns the unit vector of its translation, or the reason why it does not translate.
    pub fn translation(&self) -> Result<[f64; 2], String> {
        let distance = length(self.displacement);
        if distance < LEAST_DISPLACEMENT {
            return Err(format!(
                "does not translate: its pixels move, but their mean displacement is {distance:.2} px"
            ));
        }
        let motion = Displacement {
            mean: self.displacement,
            deviation: self.deviation,
        };
        if !motion.is_translation() {
            return Err(format!(
                "does not translate: over the object the displacement deviates by {:.2} px from its mean of {distance:.2} px",
                self.deviation
            ));
        }
        Ok(unit(self.displacement))
    }
}

impl Silhouette {
    /// Measures the total variation of a matte across and along local directions. Gradients are
    /// taken between pixels, over squares of two by two.
    fn new(matte: &Plane, directions: &Directions) -> Self {
        let (mut lateral, mut lengthwise) = (0.0, 0.0);
        for y in 1..matte.height {
            for x in 1..matte.width {
                let at = |x: u32, y: u32| f64::from(*matte.at(x, y));
                let [a, b, c, d] = [at(x - 1, y - 1), at(x, y - 1), at(x - 1, y), at(x, y)];
                let [right, down] = [(b - a + d - c) / 2.0, (c - a + d - b) / 2.0];
                let along = *directions.at(x, y);
                lateral += (down * along[0] - right * along[1]).abs();
                lengthwise += (right * along[0] + down * along[1]).abs();
            }
        }
        Self {
            lateral,
            across: lengthwise / 2.0,
        }
    }
}

/// Returns the length of a vector.
fn length(vector: [f64; 2]) -> f64 {
    vector[0].hypot(vector[1])
}

fn mean(vectors: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|axis| vectors.iter().map(|v| v[axis]).sum::<f64>() / vectors.len() as f64)
}

/// Returns the vector's direction; zero for displacements that count as none.
fn unit(vector: [f64; 2]) -> [f64; 2] {
    let distance = length(vector);
    if distance < LEAST_DISPLACEMENT {
        [0.0, 0.0]
    } else {
        vector.map(|component| component / distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn translation(displacement: [f64; 2], deviation: f64) -> Result<[f64; 2], String> {
        let silhouette = Silhouette {
            lateral: 2.0,
            across: 1.0,
        };
        let mover = Mover {
            displacement,
            deviation,
            silhouette,
        };
        mover.translation()
    }

    #[test]
    fn a_mover_translates_if_its_pixels_deviate_by_at_most_a_tenth_of_their_mean() {
        assert_eq!(translation([6.0, -8.0], 0.0), Ok([0.6, -0.8]));
        assert_eq!(translation([6.0, -8.0], 1.0), Ok([0.6, -0.8]));
        let reason = translation([6.0, -8.0], 1.001).unwrap_err();
        assert!(
            reason.contains("deviates by 1.00 px from its mean of 10.00 px"),
            "{reason}"
        );
        // A tenth of a pixel is the least that counts as motion.
        assert_eq!(translation([0.1, 0.0], 0.0), Ok([1.0, 0.0]));
        let reason = translation([0.099, 0.0], 0.0).unwrap_err();
        assert!(
            reason.contains("their mean displacement is 0.10 px"),
            "{reason}"
        );
    }
}
