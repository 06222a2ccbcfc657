//! Planes as the colours of images: a filter blurs three at once.

use frame::{Image, Plane, Raster};

/// Packs three planes per image; the last image is padded with zeros.
pub fn pack_planes(planes: &[Plane]) -> Vec<Image> {
    let pack = |chunk: &[Plane]| {
        Raster::from_fn(chunk[0].width, chunk[0].height, |x, y| {
            std::array::from_fn(|c| chunk.get(c).map_or(0.0, |plane| *plane.at(x, y)))
        })
    };
    planes.chunks(3).map(pack).collect()
}

/// Unpacks planes from images.
pub fn unpack_planes(images: &[Image], count: usize) -> Vec<Plane> {
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
        assert_eq!(unpack_planes(&pack_planes(&planes), 5), planes);
    }
}
