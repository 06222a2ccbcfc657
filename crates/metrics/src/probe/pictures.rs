//! Probes: pictures of ones, coordinates and their products, and a filter's output for them.

use frame::{Image, Plane, Raster, Vectors};

/// Sums of a filter's weights per pixel, times 1, coordinates and their products. Coordinates are
/// in pixels from the picture's middle, +x right, +y down.
#[derive(Clone, Debug, PartialEq)]
pub struct Probes {
    /// Sums of the weights.
    pub weight: Plane,
    /// Sums of weight times x and y.
    pub first: Vectors,
    /// Sums of weight times xx, xy and yy.
    pub second: Raster<[f32; 3]>,
}

impl Probes {
    /// Makes the pictures to run through a filter: (x, y, 1) and (xx, xy, yy).
    pub fn images(width: u32, height: u32) -> [Image; 2] {
        Self::images_with_step(width, height, [1.0; 2])
    }

    /// Makes them for a filter that runs on a smaller picture, whose pixels are `step` pixels wide
    /// and high.
    pub fn images_with_step(width: u32, height: u32, step: [f32; 2]) -> [Image; 2] {
        let place = |x: u32, y: u32| {
            [
                step[0] * (x as f32 + 0.5 - 0.5 * width as f32),
                step[1] * (y as f32 + 0.5 - 0.5 * height as f32),
            ]
        };
        [
            Raster::from_fn(width, height, |x, y| {
                let [x, y] = place(x, y);
                [x, y, 1.0]
            }),
            Raster::from_fn(width, height, |x, y| {
                let [x, y] = place(x, y);
                [x * x, x * y, y * y]
            }),
        ]
    }

    /// Reads the filter's outputs for [`Probes::images`], in their order.
    pub fn of(outputs: [&Image; 2]) -> Self {
        Self {
            weight: outputs[0].map(|sums| sums[2]),
            first: outputs[0].map(|sums| [sums[0], sums[1]]),
            second: outputs[1].clone(),
        }
    }
}
