//! The means of pixels of a picture: of one, and of many.

use frame::{Image, Picture, Plane, Tile};
use glam::DVec3;
use rayon::prelude::*;

use crate::film::at_instant::InstantMeans;

/// The mean of one complete set of samples of one pixel of one picture.
#[derive(Clone, Debug)]
pub(crate) struct Estimate {
    pub radiance: DVec3,
    /// Share of the samples that met a surface and then scattered, per bounce: the mean number of
    /// bounces.
    pub bounces: f64,
    /// Samples that saw each object, by id; a sample that sees through translucent surfaces is
    /// shared out.
    pub seen: Vec<f64>,
    /// Means at the instant, if the film has a view of it.
    pub at_instant: Option<InstantMeans>,
}

/// Means over the samples of some pixels of one picture, in their order.
pub(crate) struct Means {
    pub color: Vec<[f32; 3]>,
    /// Share of each object, by id.
    pub coverage: Vec<Vec<f32>>,
    /// Nothing without a view of the instant.
    pub at_instant: Vec<InstantMeans>,
}

impl Means {
    /// No means yet, with room for those of some pixels over a number of objects.
    pub fn with_room(pixels: usize, objects: usize) -> Self {
        let coverage = || Vec::with_capacity(pixels);
        Self {
            color: Vec::with_capacity(pixels),
            coverage: std::iter::repeat_with(coverage).take(objects).collect(),
            at_instant: Vec::new(),
        }
    }

    /// Joins the means of several parts of a picture's pixels.
    pub fn join(parts: &[&Means]) -> Self {
        let objects = parts.first().map_or(0, |part| part.coverage.len());
        let coverage = |object| concat(parts, |part| &part.coverage[object]);
        let (coverage, (color, at_instant)) = rayon::join(
            || (0..objects).into_par_iter().map(coverage).collect(),
            || {
                let color = concat(parts, |part| &part.color);
                (color, concat(parts, |part| &part.at_instant))
            },
        );
        Self {
            color,
            coverage,
            at_instant,
        }
    }

    /// Adds a pixel.
    pub fn push(&mut self, estimate: &Estimate) {
        self.color.push(estimate.radiance.as_vec3().to_array());
        let samples: f64 = estimate.seen.iter().sum();
        for (coverage, seen) in self.coverage.iter_mut().zip(&estimate.seen) {
            coverage.push((seen / samples) as f32);
        }
        self.at_instant.extend(estimate.at_instant);
    }

    /// Makes a picture, or a tile of one, of the means of its pixels in row-major order.
    pub fn into_picture(self, Tile { width, height, .. }: Tile) -> Picture {
        let plane = |pixels| Plane {
            width,
            height,
            pixels,
        };
        Picture {
            color: Image {
                width,
                height,
                pixels: self.color,
            },
            coverage: self.coverage.into_iter().map(plane).collect(),
        }
    }
}

/// Joins a list of each part.
fn concat<T: Copy>(parts: &[&Means], list: impl Fn(&Means) -> &Vec<T>) -> Vec<T> {
    let lists: Vec<&[T]> = parts.iter().map(|part| &list(part)[..]).collect();
    lists.concat()
}
