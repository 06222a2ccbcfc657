//! One frame of a sequence, as its pictures are measured against it.

use frame::{Image, Plane, Raster, Truth, Vectors};

/// The truth of one frame of a sequence, and the motion since the frame before. All rasters have
/// the truth's size.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant {
    /// Colours of the truth's halves.
    pub halves: [Image; 2],
    /// Pixels of [`Region::Moving`](frame::Region::Moving).
    pub moving: Raster<bool>,
    /// Pixels where each object was seen while the shutter was open, the background first.
    pub seen: Vec<Raster<bool>>,
    /// Screen motion since the frame before, in pixels; +x right, +y down.
    pub velocity: Vectors,
    /// Distance along the view axis, in metres.
    pub depth: Plane,
    /// The object at each pixel's centre; 0 is the background.
    pub object_id: Raster<u32>,
}

impl Instant {
    /// Collects what sequences need from a truth. `velocity` is the motion since the frame before
    /// at the pixels' centres, whatever kind of velocity the filter got.
    pub fn new(truth: &Truth, velocity: Vectors, depth: Plane, object_id: Raster<u32>) -> Self {
        Self {
            halves: truth.halves.each_ref().map(|half| half.color.clone()),
            moving: frame::regions(truth).moving,
            seen: truth.support.seen.clone(),
            velocity,
            depth,
            object_id,
        }
    }
}
