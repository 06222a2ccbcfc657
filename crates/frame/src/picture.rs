//! Colour and visibility together: what a half of the truth, an accumulation or a filter yields.

use crate::exr_file::{ExrFile, in_layer};
use crate::raster::{mean_plane, mean_vectors};
use crate::{FileError, Image, Plane};

/// A picture and what is seen in it. All rasters have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Scene-linear radiance.
    pub color: Image,
    /// Per object, the background first: the fraction of the pixel that shows it.
    pub coverage: Vec<Plane>,
}

impl Picture {
    pub(crate) fn push(&self, file: &mut ExrFile, layer: &str, objects: &[String]) {
        file.push_color(layer, &self.color);
        for (object, plane) in objects.iter().zip(&self.coverage) {
            file.push_plane(&coverage_name(layer, object), plane);
        }
    }

    pub(crate) fn from_exr(
        file: &ExrFile,
        layer: &str,
        objects: &[String],
    ) -> Result<Self, FileError> {
        let coverage = objects
            .iter()
            .map(|object| file.plane(&coverage_name(layer, object)))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            color: file.color(layer)?,
            coverage,
        })
    }

    /// The picture without `border` pixels on every side. Panics when nothing would be left.
    pub fn cropped(&self, border: u32) -> Picture {
        Picture {
            color: self.color.cropped(border),
            coverage: (self.coverage.iter())
                .map(|plane| plane.cropped(border))
                .collect(),
        }
    }

    /// The mean of pictures of one size, at least one; summed in `f64`, in their order.
    pub fn mean<'a>(pictures: impl IntoIterator<Item = &'a Picture>) -> Picture {
        let pictures: Vec<&Picture> = pictures.into_iter().collect();
        let first = pictures.first().expect("a mean is of at least one picture");
        Picture {
            color: mean_vectors(pictures.iter().map(|picture| &picture.color)),
            coverage: (0..first.coverage.len())
                .map(|object| mean_plane(pictures.iter().map(|picture| &picture.coverage[object])))
                .collect(),
        }
    }
}

/// Channel that holds an object's coverage, in a named layer or at the top.
pub(crate) fn coverage_name(layer: &str, object: &str) -> String {
    in_layer(layer, &format!("coverage.{object}"))
}
