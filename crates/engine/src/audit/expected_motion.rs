//! Velocity that an engine should have output, and its variants under known mistakes.

use frame::{Raster, Size, Vectors, VelocityKind};
use scene::Scene;
use tracer::{PointLayers, PointMotion, RenderSettings, TraceError, trace_motion};

use crate::audit::cause::Cause;
use crate::audit::fitted_motion::Candidate;
use crate::audit::structure::WrongDraws;

/// Sizes of smaller velocity buffers: the picture's, divided by this.
const SMALLER_BY: [u32; 2] = [2, 4];

/// Layers of the instant with the correct velocity, and velocities caused by known mistakes.
pub struct ExpectedMotion<'a> {
    /// Correct: the motion since the previous frame.
    pub right: PointLayers,
    /// Each mistake that shows other motion, with that motion; the simplest first.
    pub mistaken: Vec<(Cause, Vectors)>,
    /// The engine's draw calls, for mistakes of single objects.
    pub draws: WrongDraws<'a>,
}

impl<'a> ExpectedMotion<'a> {
    /// Traces all of them, with a few rays per pixel.
    pub fn trace(scene: &'a Scene, size: Size) -> Result<Self, TraceError> {
        let mut since_last = RenderSettings::default().with_size(size);
        since_last.options.velocity = VelocityKind::PreviousFrame;
        let trace = |motion: PointMotion| trace_motion(scene, &since_last, &motion);
        let right = trace(PointMotion::RIGHT)?;
        let mut mistaken = vec![(Cause::Zero, right.velocity.map(|_| [0.0; 2]))];
        let turns = [
            Cause::WrongSign,
            Cause::FlippedY,
            Cause::FlippedX,
            Cause::SwappedAxes,
        ];
        for turn in turns {
            let velocity = right.velocity.map(|vector| turn.apply(*vector));
            mistaken.push((turn, velocity));
        }
        let draws = WrongDraws::trace(scene, &right)?;
        mistaken.extend(draws.list_of_all());
        let of_last_points = [
            (Cause::PreviousBuffer, PointMotion::PREVIOUS_BUFFER),
            (Cause::PreviousPixel, PointMotion::PREVIOUS_PIXEL),
        ];
        for (cause, motion) in of_last_points {
            mistaken.push((cause, trace(motion)?.velocity));
        }
        mistaken.extend(list_low_resolutions(&right));
        mistaken.push((Cause::UpsideDown, upside_down(&right.velocity)));
        let mut instantaneous = since_last;
        instantaneous.options.velocity = VelocityKind::Instantaneous;
        let derivative = trace_motion(scene, &instantaneous, &PointMotion::RIGHT)?;
        mistaken.push((Cause::HalfFrameOff, derivative.velocity));
        Ok(Self {
            right,
            mistaken,
            draws,
        })
    }
}

/// Lists velocities of buffers that are smaller than the picture: blocks of pixels share the vector
/// of their corner, or the mean of their pixels of one object.
fn list_low_resolutions(right: &PointLayers) -> Vec<Candidate> {
    let mut candidates = Vec::new();
    for side in SMALLER_BY {
        let last = side - 1;
        for [across, down] in [[0, 0], [last, 0], [0, last], [last, last]] {
            let corner = |x: u32, y: u32, _| *right.velocity.at(x + across, y + down);
            candidates.push(share_blocks(right, side, &corner));
        }
        let mean = |x: u32, y: u32, id: u32| mean_of_block(right, side, [x, y], id);
        candidates.push(share_blocks(right, side, &mean));
    }
    let sides = SMALLER_BY.into_iter().flat_map(|side| [side; 5]);
    let causes = sides.map(Cause::LowResolution);
    causes.zip(candidates).collect()
}

/// Gives each pixel a vector of its block, from the block's first column and row and the pixel's
/// object; right at the margin, which fills no block.
fn share_blocks(
    right: &PointLayers,
    side: u32,
    vector: &dyn Fn(u32, u32, u32) -> [f32; 2],
) -> Vectors {
    let Size { width, height } = right.velocity.size();
    Raster::from_fn(width, height, |x, y| {
        let [first_x, first_y] = [x, y].map(|place| place / side * side);
        if first_x + side > width || first_y + side > height {
            return *right.velocity.at(x, y);
        }
        vector(first_x, first_y, *right.object_id.at(x, y))
    })
}

fn mean_of_block(right: &PointLayers, side: u32, [x, y]: [u32; 2], id: u32) -> [f32; 2] {
    let places = (y..y + side).flat_map(|y| (x..x + side).map(move |x| (x, y)));
    let same = places.filter(|(x, y)| *right.object_id.at(*x, *y) == id);
    let (sum, count) = same.fold(([0.0; 2], 0.0), |(sum, count), (x, y)| {
        let vector = right.velocity.at(x, y);
        ([0, 1].map(|axis| sum[axis] + vector[axis]), count + 1.0)
    });
    sum.map(|part| part / count)
}

/// Reverses the order of the rows.
pub(super) fn upside_down<T: Clone>(raster: &Raster<T>) -> Raster<T> {
    let (width, height) = (raster.width, raster.height);
    Raster::from_fn(width, height, |x, y| raster.at(x, height - 1 - y).clone())
}
