//! FLIP of two pictures.

use frame::{Display, decode_srgb};
use measure::Error;
use metrics::flip_ldr;
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
        let display = Display {
            stops,
            ..Display::default()
        };
        display.check_stops().map_err(Error::Refused)?;
        Ok(flip_ldr(
            &decode(reference),
            &decode(image),
            &display.into(),
        ))
    })?;
    Ok(give_plane(py, map))
}
