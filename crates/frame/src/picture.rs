//! Colour and visibility together: what a half of the truth, an accumulation or a filter yields.

use crate::exr_file::ExrFile;
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

    /// The mean of two pictures.
    pub fn mean(halves: &[Picture; 2]) -> Picture {
        let [a, b] = halves;
        Picture {
            color: a.color.zip(&b.color, |a, b| {
                std::array::from_fn(|c| 0.5 * (a[c] + b[c]))
            }),
            coverage: a
                .coverage
                .iter()
                .zip(&b.coverage)
                .map(|(a, b)| a.zip(b, |a, b| 0.5 * (a + b)))
                .collect(),
        }
    }
}

/// Channel that holds an object's coverage, in a named layer or at the top.
pub(crate) fn coverage_name(layer: &str, object: &str) -> String {
    if layer.is_empty() {
        format!("coverage.{object}")
    } else {
        format!("{layer}.coverage.{object}")
    }
}
