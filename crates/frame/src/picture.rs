//! Colour and visibility together: what a half of the truth, an accumulation or a filter yields.

use crate::exr_file::ExrFile;
use crate::{FileError, Image, Plane, Raster};

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
        let colors: Vec<&Image> = pictures.iter().map(|picture| &picture.color).collect();
        let coverage = |object: usize| {
            let planes: Vec<&Plane> = (pictures.iter())
                .map(|picture| &picture.coverage[object])
                .collect();
            mean(&planes, |planes, pixel| {
                mean_of(planes.iter().map(|plane| plane.pixels[pixel]))
            })
        };
        Picture {
            color: mean(&colors, |images, pixel| {
                std::array::from_fn(|component| {
                    mean_of(images.iter().map(|image| image.pixels[pixel][component]))
                })
            }),
            coverage: (0..first.coverage.len()).map(coverage).collect(),
        }
    }
}

/// A raster of the size of all `rasters`, made pixel by pixel.
fn mean<T>(rasters: &[&Raster<T>], value: impl Fn(&[&Raster<T>], usize) -> T) -> Raster<T> {
    let first = rasters[0];
    assert!(
        rasters.iter().all(|raster| raster.same_size(first)),
        "a mean is of pictures of one size"
    );
    Raster {
        width: first.width,
        height: first.height,
        pixels: (0..first.pixels.len())
            .map(|pixel| value(rasters, pixel))
            .collect(),
    }
}

fn mean_of(values: impl ExactSizeIterator<Item = f32>) -> f32 {
    let count = values.len() as f64;
    (values.map(f64::from).sum::<f64>() / count) as f32
}

/// Channel that holds an object's coverage, in a named layer or at the top.
pub(crate) fn coverage_name(layer: &str, object: &str) -> String {
    if layer.is_empty() {
        format!("coverage.{object}")
    } else {
        format!("{layer}.coverage.{object}")
    }
}
