//! A camera framed on a model without one, and floor and wall around it.

use glam::DVec3;

use super::moment::Clip;
use super::piece::Piece;
use super::stage::Stage;
use super::view::{Camera, Film};
use crate::import::framing::{self, SIZE, VERTICAL_FOV, VIEW};
use crate::import::set::WALL_DISTANCE;

/// A model's box around the instant, in metres.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    pub low: DVec3,
    pub high: DVec3,
}

impl Extent {
    /// Measures the pieces a frame before the instant, at it and a frame after.
    pub fn of(stage: &Stage, clip: &Clip, pieces: &[Piece]) -> Self {
        let mut extent = Self {
            low: DVec3::INFINITY,
            high: DVec3::NEG_INFINITY,
        };
        for piece in pieces {
            for frame in [-1.0, 0.0, 1.0] {
                for position in piece.positions(stage, clip.moment(frame).seconds) {
                    extent.low = extent.low.min(position);
                    extent.high = extent.high.max(position);
                }
            }
        }
        extent
    }

    pub fn middle(&self) -> DVec3 {
        0.5 * (self.low + self.high)
    }

    /// Returns the radius of the ball around the box.
    pub fn radius(&self) -> f64 {
        0.5 * (self.high - self.low).length()
    }
}

/// Frames a camera on a model, which it goes around by so many degrees per frame.
pub fn frame_model(extent: &Extent, orbit: f64) -> (Camera, Film) {
    let camera = Camera::Around {
        target: extent.middle(),
        distance: framing::distance(extent.radius()),
        direction: VIEW,
        orbit,
    };
    let film = Film {
        width: SIZE.width,
        height: SIZE.height,
        vertical_fov: VERTICAL_FOV.to_radians(),
    };
    (camera, film)
}

/// Tables of a floor below the model and a wall behind it.
pub fn set_toml(extent: &Extent) -> String {
    let radius = extent.radius();
    let middle = extent.middle();
    let around = VIEW[0].to_radians();
    let wall = middle - WALL_DISTANCE * radius * DVec3::new(around.sin(), 0.0, around.cos());
    // Below the model, so that no two surfaces coincide.
    let floor = extent.low.y - 0.005 * radius;
    format!(
        "\n[object.floor]\nmesh = \"floor.obj\"\ntranslation = [{:?}, {floor:?}, {:?}]\n\
         rotation = {{ axis = [1, 0, 0], degrees = -90 }}\n\n\
         [object.wall]\nmesh = \"wall.obj\"\ntranslation = [{:?}, {floor:?}, {:?}]\n\
         rotation = {{ axis = [0, 1, 0], degrees = {:?} }}\n",
        middle.x, middle.z, wall.x, wall.z, VIEW[0]
    )
}
