//! Flat shapes, their motions and their smears.

use crate::vector::{direction, dot, length, minus};

/// A flat shape around its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A disc of this radius, in pixels.
    Disc(f64),
    /// A rectangle of these half sides, in pixels; the first one is turned by `tilt` radians from
    /// +x.
    Bar {
        /// Half lengths along and across its axis.
        half: [f64; 2],
        /// Angle of its axis, in radians.
        tilt: f64,
    },
}

/// A moving shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Object {
    /// Shape and size.
    pub shape: Shape,
    /// Centre at the instant, in pixels.
    pub center: [f64; 2],
    /// Translation over the shutter, in pixels.
    pub displacement: [f64; 2],
    /// Rotation about its centre over the shutter, in radians.
    pub turn: f64,
}

/// A smear of moving objects, right or wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blur {
    /// Start of the smear, in displacements from the instant.
    pub from: f64,
    /// End of the smear, in displacements from the instant.
    pub to: f64,
    /// Sub-frames at the midpoints of equal parts; none for a continuous smear.
    pub subframes: Option<u32>,
    /// Shift along and across the motion, in pixels.
    pub shift: [f64; 2],
    /// Dilation across the motion to both sides, in pixels.
    pub dilation: f64,
}

impl Blur {
    /// Smear that a camera with a trailing shutter sees.
    pub const TRUE: Blur = Blur {
        from: -1.0,
        to: 0.0,
        subframes: None,
        shift: [0.0, 0.0],
        dilation: 0.0,
    };
    /// No blur: the instant.
    pub const IDENTITY: Blur = Blur {
        from: 0.0,
        ..Blur::TRUE
    };

    /// Makes the mean of `subframes` instants.
    pub fn accumulation(subframes: u32) -> Blur {
        Blur {
            subframes: Some(subframes),
            ..Blur::TRUE
        }
    }
}

impl Object {
    /// Makes an object that only translates.
    pub fn sliding(shape: Shape, center: [f64; 2], displacement: [f64; 2]) -> Self {
        Self {
            shape,
            center,
            displacement,
            turn: 0.0,
        }
    }

    pub(crate) fn moves(&self) -> bool {
        self.displacement != [0.0, 0.0] || self.turn != 0.0
    }
}

/// An object with everything that all samples of a blur share.
pub(crate) struct Posed {
    object: Object,
    blur: Blur,
    along: [f64; 2],
    across: [f64; 2],
    /// Sine and cosine of a bar's tilt, reversed.
    tilt: [f64; 2],
    /// A step across the motion, in a bar's own axes.
    step: [f64; 2],
    /// Centres at the start and end of the blur, in pixels.
    path: [[f64; 2]; 2],
    /// Distance from the path that no part of the smear exceeds, in pixels.
    reach: f64,
}

impl Posed {
    pub(crate) fn new(object: &Object, blur: &Blur) -> Self {
        let (size, tilt) = match object.shape {
            Shape::Disc(radius) => (radius, 0.0),
            Shape::Bar { half, tilt } => (length(half), tilt),
        };
        let center_at =
            |time: f64| [0, 1].map(|axis| object.center[axis] + time * object.displacement[axis]);
        let shift = length(blur.shift) + blur.dilation;
        let along = unit(object.displacement);
        let across = [-along[1], along[0]];
        let tilt = (-tilt).sin_cos().into();
        Self {
            object: *object,
            blur: *blur,
            along,
            across,
            tilt,
            step: rotate(across, tilt),
            path: [blur.from, blur.to].map(center_at),
            reach: size + shift + 1.0,
        }
    }

    /// Returns whether any part of a pixel can see the object at any time of the blur. It may
    /// return true wrongly.
    pub(crate) fn reaches(&self, pixel: [u32; 2]) -> bool {
        let [start, end] = self.path;
        let way = minus(end, start);
        let offset = minus(pixel.map(|place| f64::from(place) + 0.5), start);
        // Part of the way at which the path is nearest; a still object has no way.
        let part = (dot(offset, way) / dot(way, way).max(1e-12)).clamp(0.0, 1.0);
        let distance = minus(offset, way.map(|side| part * side));
        dot(distance, distance) <= self.reach * self.reach
    }

    /// Converts a point to the object's own coordinates, its centre at (0, 0), at `time`
    /// displacements from the instant.
    pub(crate) fn local(&self, point: [f64; 2], time: f64) -> [f64; 2] {
        // No loops over axes: a picture has millions of samples, and this crate is not much
        // optimised.
        let (object, shift) = (&self.object, self.blur.shift);
        let (center, displacement) = (object.center, object.displacement);
        let (along, across) = (self.along, self.across);
        let moved = [
            point[0]
                - center[0]
                - displacement[0] * time
                - along[0] * shift[0]
                - across[0] * shift[1],
            point[1]
                - center[1]
                - displacement[1] * time
                - along[1] * shift[0]
                - across[1] * shift[1],
        ];
        match object.turn {
            0.0 => moved,
            turn => {
                let (sin, cos) = (-turn * time).sin_cos();
                rotate(moved, [sin, cos])
            }
        }
    }

    /// Returns whether a point in the object's own coordinates is inside it, after a dilation
    /// across its motion to both sides.
    pub(crate) fn holds(&self, local: [f64; 2]) -> bool {
        let dilation = self.blur.dilation;
        match self.object.shape {
            Shape::Disc(radius) => {
                let aside = dot(local, self.across);
                let nearer = aside - aside.clamp(-dilation, dilation);
                let ahead = dot(local, self.along);
                ahead * ahead + nearer * nearer <= radius * radius
            }
            Shape::Bar { half, .. } => {
                // Steps across the motion that stay within both pairs of sides, and within the
                // dilation.
                let (at, step) = (rotate(local, self.tilt), self.step);
                let all = [-dilation, dilation];
                let steps = steps_within(at[0], step[0], half[0], all)
                    .and_then(|steps| steps_within(at[1], step[1], half[1], steps));
                steps.is_some_and(|[first, last]| first <= last)
            }
        }
    }
}

/// Narrows steps from a place to those that stay within `half` of 0 on one axis; none if no step
/// changes a place outside.
fn steps_within(at: f64, step: f64, half: f64, [first, last]: [f64; 2]) -> Option<[f64; 2]> {
    if step.abs() < 1e-12 {
        return (at.abs() <= half).then_some([first, last]);
    }
    let ends = [(-half - at) / step, (half - at) / step];
    Some([
        first.max(ends[0].min(ends[1])),
        last.min(ends[0].max(ends[1])),
    ])
}

fn rotate([x, y]: [f64; 2], [sin, cos]: [f64; 2]) -> [f64; 2] {
    [cos * x - sin * y, sin * x + cos * y]
}

fn unit(vector: [f64; 2]) -> [f64; 2] {
    direction(vector, [1.0, 0.0])
}
