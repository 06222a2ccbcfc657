//! FLIP of two pictures.

use frame::{Display, decode_srgb};
use metrics::{Viewing, flip_ldr};
use numpy::PyReadonlyArray3;
use pyo3::prelude::*;

use crate::arrays::{Array2, give_plane, take_image};
use crate::work::work;

/// Maps LDR-FLIP of two pictures of one size.
#[pyfunction]
pub fn flip<'py>(
    py: Python<'py>,
    reference: PyReadonlyArray3<f32>,
    image: PyReadonlyArray3<f32>,
    stops: f32,
    srgb: bool,
) -> PyResult<Array2<'py, f32>> {
    let decode = |picture: frame::Image| {
        if srgb {
            picture.map(|pixel| pixel.map(decode_srgb))
        } else {
            picture
        }
    };
    let (reference, image) = (take_image(&reference)?, take_image(&image)?);
    let map = work(py, || {
        let viewing = Viewing::from(Display {
            stops,
            ..Display::default()
        });
        Ok(flip_ldr(&decode(reference), &decode(image), &viewing))
    })?;
    Ok(give_plane(py, map))
}
