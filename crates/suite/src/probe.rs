//! A filter's picture: its colour, and what it makes of every object's matte.

use filters::{FilterError, Input};
use frame::{Frame, Image, Picture, Plane, Raster};

use crate::Runner;

/// Runs the filter on the frame's colour and, with the same weights, on the instant's coverage of each object: what comes
/// out is the share of the pixel that the filter gives to that object.
pub fn picture(
    filter: &mut Runner,
    frame: &Frame,
    frame_index: u32,
) -> Result<Picture, FilterError> {
    let mattes = pack(&frame.coverage);
    let colors: Vec<&Image> = std::iter::once(&frame.color).chain(&mattes).collect();
    let mut outputs = filter.run(&input(frame, &colors, frame_index))?;
    let color = outputs.remove(0);
    Ok(Picture {
        color,
        coverage: unpack(&outputs, frame.coverage.len()),
    })
}

/// Runs the filter on the frame's colour alone.
pub(crate) fn color(
    filter: &mut Runner,
    frame: &Frame,
    frame_index: u32,
) -> Result<Image, FilterError> {
    Ok(filter
        .run(&input(frame, &[&frame.color], frame_index))?
        .remove(0))
}

fn input<'a>(frame: &'a Frame, color: &'a [&'a Image], frame_index: u32) -> Input<'a> {
    Input {
        color,
        velocity: &frame.velocity,
        depth: &frame.depth,
        reprojection: Some(frame.reprojection.moved(f64::from(frame.guard_band))),
        exposure: frame.exposure,
        frame_index,
    }
}

/// Three planes to an image; the last is filled up with zeros.
fn pack(planes: &[Plane]) -> Vec<Image> {
    planes
        .chunks(3)
        .map(|chunk| {
            let size = &chunk[0];
            Raster {
                width: size.width,
                height: size.height,
                pixels: (0..size.pixels.len())
                    .map(|at| {
                        std::array::from_fn(|c| chunk.get(c).map_or(0.0, |plane| plane.pixels[at]))
                    })
                    .collect(),
            }
        })
        .collect()
}

fn unpack(images: &[Image], count: usize) -> Vec<Plane> {
    (0..count)
        .map(|plane| images[plane / 3].map(|pixel| pixel[plane % 3]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_come_back_in_their_order() {
        let planes: Vec<Plane> = (0..5)
            .map(|k| Raster::from_fn(4, 3, |x, y| (k * 100 + y * 4 + x) as f32))
            .collect();
        assert_eq!(unpack(&pack(&planes), 5), planes);
    }
}
