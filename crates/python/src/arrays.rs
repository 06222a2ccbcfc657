//! Rasters as arrays of numpy.

use frame::{Image, Plane, Raster, Vectors};
use numpy::ndarray::ArrayView;
use numpy::{
    Element, Ix2, Ix3, PyArray, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray3,
    PyUntypedArrayMethods,
};
use pyo3::prelude::*;

/// An array of shape (height, width, 3) or (height, width, 2).
pub type Array3<'py> = Bound<'py, PyArray3<f32>>;
/// An array of shape (height, width).
pub type Array2<'py, T> = Bound<'py, PyArray2<T>>;

/// Shows an image that `owner` holds, without a copy.
pub fn view_image<'py>(owner: &Bound<'py, PyAny>, image: &Image) -> Array3<'py> {
    view3(owner, image)
}

/// Shows vectors that `owner` holds, without a copy.
pub fn view_vectors<'py>(owner: &Bound<'py, PyAny>, vectors: &Vectors) -> Array3<'py> {
    view3(owner, vectors)
}

/// Shows a plane that `owner` holds, without a copy.
pub fn view_plane<'py, T: Element>(owner: &Bound<'py, PyAny>, plane: &Raster<T>) -> Array2<'py, T> {
    let shape = (plane.height as usize, plane.width as usize);
    let view = ArrayView::from_shape(shape, &plane.pixels).expect("a raster is full");
    lend::<_, Ix2>(owner, view)
}

fn view3<'py, const N: usize>(owner: &Bound<'py, PyAny>, raster: &Raster<[f32; N]>) -> Array3<'py> {
    let shape = (raster.height as usize, raster.width as usize, N);
    let view = ArrayView::from_shape(shape, raster.pixels.as_flattened());
    lend::<_, Ix3>(owner, view.expect("a raster is full"))
}

/// Makes a read-only array of memory that `owner` holds.
#[expect(
    unsafe_code,
    reason = "numpy has no safe way to show memory that a Python object owns"
)]
fn lend<'py, T: Element, D: numpy::ndarray::Dimension>(
    owner: &Bound<'py, PyAny>,
    view: ArrayView<T, D>,
) -> Bound<'py, PyArray<T, D>> {
    // SAFETY: the array keeps `owner` alive. All owners are frozen classes, which nothing changes
    // after they are made, so the memory stays in place; and the array is not writeable.
    let array = unsafe { PyArray::borrow_from_array(&view, owner.clone()) };
    let flags = array.getattr("flags");
    let closed = flags.and_then(|flags| flags.setattr("writeable", false));
    closed.expect("an array can be closed");
    array
}

/// Hands an image to numpy, without a copy.
pub fn give_image(py: Python, image: Image) -> Array3 {
    let shape = [image.height as usize, image.width as usize, 3];
    give(py, image.pixels.into_flattened(), shape)
}

/// Hands a plane to numpy, without a copy.
pub fn give_plane(py: Python, plane: Plane) -> Array2<f32> {
    let shape = [plane.height as usize, plane.width as usize];
    let flat = numpy::PyArray1::from_vec(py, plane.pixels);
    flat.reshape(shape).expect("a raster is full")
}

fn give(py: Python, values: Vec<f32>, shape: [usize; 3]) -> Array3 {
    let flat = numpy::PyArray1::from_vec(py, values);
    flat.reshape(shape).expect("a raster is full")
}

/// Copies an array of shape (height, width, 3), which the caller has checked.
pub fn take_image(array: &PyReadonlyArray3<f32>) -> PyResult<Image> {
    let (width, height) = (array.shape()[1] as u32, array.shape()[0] as u32);
    let (pixels, _) = array.as_slice()?.as_chunks::<3>();
    Ok(Raster {
        width,
        height,
        pixels: pixels.to_vec(),
    })
}
