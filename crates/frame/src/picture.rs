//! Pictures: colour and coverage, as a half of the truth, an accumulation or a filter yields them.

use crate::exr::{ExrFile, in_layer};
use crate::raster::{mean_plane, mean_vectors};
use crate::{FileError, Image, Plane, Tile};

/// Colour, and the coverage of every object. All rasters have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Scene-linear radiance.
    pub color: Image,
    /// Fraction of the pixel that shows the object, per object, the background first.
    pub coverage: Vec<Plane>,
}

impl Picture {
    /// Copies the pixels of a tile.
    pub fn part(&self, tile: Tile) -> Self {
        Self {
            color: self.color.part(tile),
            coverage: self.coverage.iter().map(|plane| plane.part(tile)).collect(),
        }
    }

    /// Adds the channels of colour and coverage, in a named layer or at the top, to a file.
    pub fn push(&self, file: &mut ExrFile, layer: &str, objects: &[String]) {
        self.clone().move_to(file, layer, objects);
    }

    /// Adds the same channels as [`Picture::push`], without copying coverage.
    pub(crate) fn move_to(self, file: &mut ExrFile, layer: &str, objects: &[String]) {
        file.push_color(layer, &self.color);
        for (object, plane) in objects.iter().zip(self.coverage) {
            file.push_owned_plane(&coverage_name(layer, object), plane);
        }
    }

    /// Takes the picture out of a file.
    pub fn take_from(
        file: &mut ExrFile,
        layer: &str,
        objects: &[String],
    ) -> Result<Self, FileError> {
        let coverage = objects
            .iter()
            .map(|object| file.take_plane(&coverage_name(layer, object)))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            color: file.color(layer)?,
            coverage,
        })
    }

    /// Removes `border` pixels on every side. Panics if nothing would be left.
    pub fn cropped(&self, border: u32) -> Picture {
        Picture {
            color: self.color.cropped(border),
            coverage: (self.coverage.iter())
                .map(|plane| plane.cropped(border))
                .collect(),
        }
    }

    /// Adds another picture of the same size and objects, pixel by pixel.
    pub fn plus(&self, other: &Picture) -> Picture {
        self.combine(other, |a, b| a + b)
    }

    /// Subtracts another picture of the same size and objects, pixel by pixel.
    pub fn minus(&self, other: &Picture) -> Picture {
        self.combine(other, |a, b| a - b)
    }

    fn combine(&self, other: &Picture, join: impl Fn(f32, f32) -> f32) -> Picture {
        let color = self.color.zip(&other.color, |a, b| {
            std::array::from_fn(|component| join(a[component], b[component]))
        });
        let coverages = self.coverage.iter().zip(&other.coverage);
        Picture {
            color,
            coverage: coverages
                .map(|(a, b)| a.zip(b, |a, b| join(*a, *b)))
                .collect(),
        }
    }

    /// Averages at least one picture, all of one size; sums in `f64`, in their order.
    pub fn mean<'a>(pictures: impl IntoIterator<Item = &'a Picture>) -> Picture {
        let pictures: Vec<&Picture> = pictures.into_iter().collect();
        let first = pictures.first().expect("a mean needs at least one picture");
        Picture {
            color: mean_vectors(pictures.iter().map(|picture| &picture.color)),
            coverage: (0..first.coverage.len())
                .map(|object| mean_plane(pictures.iter().map(|picture| &picture.coverage[object])))
                .collect(),
        }
    }
}

/// Names the channel of an object's coverage, in a named layer or at the top.
fn coverage_name(layer: &str, object: &str) -> String {
    in_layer(layer, &format!("coverage.{object}"))
}
