//! A rendered frame with its truth.

use frame::{FrameOptions, Image, Picture, Size, VelocityKind};
use measure::{Error, MemoryRender, RenderedScene};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use scene::{Location, Scene, list_scenes};
use terminal::arguments::default_scenes_root;
use terminal::selection::select_scenes;
use tracer::RenderSettings;

use crate::arrays::{Array2, Array3, view_image, view_plane, view_vectors};
use crate::error::to_exception;
use crate::work::{MONITOR, work};

/// What to render of a scene.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct RenderOptions {
    size: [u32; 2],
    exposure: Option<f64>,
    samples: u32,
    seed: u64,
    subframes: u32,
    alignment: String,
    velocity: String,
    at_frame: u32,
    noise: Option<f64>,
    scenes_dir: Option<String>,
}

/// One frame of a scene and its truth: the picture that a camera with an open shutter takes.
///
/// Arrays are read-only views of memory that the object holds; copy one before you change it.
/// Pictures are scene-linear Rec.709 radiance, 0 and above, not limited to 1: float32 of shape
/// (height, width, 3), row 0 at the top. Velocities are float32 of shape (height, width, 2), +x
/// right, +y down.
#[pyclass(frozen, module = "shuttertruth")]
pub struct Render {
    pub scene: RenderedScene,
    name: String,
    mean: Picture,
}

/// Lists the scenes of a folder, or the program's own.
#[pyfunction]
pub fn scene_names(scenes_dir: Option<&str>) -> PyResult<Vec<String>> {
    let listings = list_scenes(scenes_root(scenes_dir)).map_err(to_exception)?;
    Ok(listings.into_iter().map(|listing| listing.name).collect())
}

/// Renders a scene's frame and its truth.
#[pyfunction]
pub fn render(py: Python, scene: String, options: RenderOptions) -> PyResult<Render> {
    work(py, || {
        let alignment = options.alignment.parse().map_err(Error::Refused)?;
        let velocity = options.velocity.parse().map_err(Error::Refused)?;
        let scene = load(scene, &options)?;
        let rendered = MemoryRender {
            scene: &scene,
            settings: settings(&options, velocity),
            alignment,
            noise: options.noise,
            subframes: options.subframes,
            monitor: MONITOR,
        }
        .render()?;
        Ok(Render {
            mean: rendered.truth.mean(),
            name: scene.id.to_string(),
            scene: rendered,
        })
    })
}

fn scenes_root(folder: Option<&str>) -> Location {
    match folder {
        Some(folder) => std::path::Path::new(folder).into(),
        None => default_scenes_root(),
    }
}

fn load(name: String, options: &RenderOptions) -> Result<Scene, Error> {
    let root = scenes_root(options.scenes_dir.as_deref());
    let mut choices = select_scenes(root, std::slice::from_ref(&name))?;
    if choices.len() > 1 {
        let names: Vec<String> = (choices.iter())
            .map(|choice| choice.scene.id.to_string())
            .collect();
        return Err(Error::Refused(format!(
            "scene \"{name}\" names {} scenes; allowed: one, such as {}",
            names.len(),
            names.join(", ")
        )));
    }
    Ok(choices.remove(0).scene.at_frame(options.at_frame))
}

fn settings(options: &RenderOptions, velocity: VelocityKind) -> RenderSettings {
    RenderSettings {
        samples_per_pixel: options.samples,
        seed: options.seed,
        exposure: options.exposure,
        options: FrameOptions {
            velocity,
            ..FrameOptions::default()
        },
        ..RenderSettings::default()
    }
    .with_size(options.size.into())
}

#[pymethods]
impl Render {
    /// Truth: radiance integrated over the shutter.
    #[getter]
    fn blurred<'py>(slf: &Bound<'py, Self>) -> Array3<'py> {
        view_image(slf.as_any(), &slf.get().mean.color)
    }

    /// Two independent halves of `blurred`, which is their mean: their difference shows its noise.
    #[getter]
    fn halves<'py>(slf: &Bound<'py, Self>) -> [Array3<'py>; 2] {
        let halves = slf.get().scene.truth.halves.each_ref();
        halves.map(|half| view_image(slf.as_any(), &half.color))
    }

    /// Standard error of `blurred`, per channel, in radiance.
    #[getter]
    fn standard_error<'py>(slf: &Bound<'py, Self>) -> Array3<'py> {
        view_image(slf.as_any(), &slf.get().scene.truth.standard_error)
    }

    /// Sharp picture of the instant, time 0, which a filter gets.
    #[getter]
    fn frame<'py>(slf: &Bound<'py, Self>) -> Array3<'py> {
        view_image(slf.as_any(), &slf.get().scene.frame.color)
    }

    /// Motion at the instant, in pixels per frame: the kind that `render` was asked for.
    #[getter]
    fn velocity<'py>(slf: &Bound<'py, Self>) -> Array3<'py> {
        view_vectors(slf.as_any(), &slf.get().scene.frame.velocity)
    }

    /// Motion of the same points from the instant to the next frame, in pixels.
    #[getter]
    fn velocity_next<'py>(slf: &Bound<'py, Self>) -> Array3<'py> {
        let next = slf.get().scene.frame.velocity_next.as_ref();
        view_vectors(slf.as_any(), next.expect("a render adds it"))
    }

    /// Distance along the view axis in metres, above 0; 1e10 where nothing is seen. Shape (height,
    /// width).
    #[getter]
    fn depth<'py>(slf: &Bound<'py, Self>) -> Array2<'py, f32> {
        view_plane(slf.as_any(), &slf.get().scene.frame.depth)
    }

    /// Object seen at the pixel's centre: an index of `objects`, uint32 of shape (height, width).
    #[getter]
    fn object_id<'py>(slf: &Bound<'py, Self>) -> Array2<'py, u32> {
        view_plane(slf.as_any(), &slf.get().scene.frame.object_id)
    }

    /// Names of the objects; the first is `background`.
    #[getter]
    fn objects(&self) -> Vec<String> {
        self.scene.truth.objects.clone()
    }

    /// Share of shutter and pixel that shows each object, by its name: float32 in 0 to 1, shape
    /// (height, width).
    #[getter]
    fn coverage<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        let render = slf.get();
        let coverage = PyDict::new(slf.py());
        for (object, plane) in render.scene.truth.objects.iter().zip(&render.mean.coverage) {
            coverage.set_item(object, view_plane(slf.as_any(), plane))?;
        }
        Ok(coverage)
    }

    /// Sharp pictures at the middles of equal parts of the shutter, the earliest first; empty
    /// unless `render` was asked for some.
    #[getter]
    fn subframes<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let subframes: &[Image] = &slf.get().scene.subframes;
        let views = subframes
            .iter()
            .map(|image| view_image(slf.as_any(), image));
        PyTuple::new(slf.py(), views)
    }

    /// Noise of `blurred` where anything moves: a root mean square of radiance.
    #[getter]
    fn noise(&self) -> f64 {
        measure::deciding_floor(&self.scene.truth).1
    }

    /// Noise of `frame` over the whole picture: a root mean square of radiance.
    #[getter]
    fn frame_noise(&self) -> f64 {
        self.scene.frame_noise
    }

    /// Times at which the shutter opens and closes, in frames; the instant is 0.
    #[getter]
    fn shutter(&self) -> (f64, f64) {
        let shutter = self.scene.truth.shutter;
        (shutter.open, shutter.close)
    }

    /// Place of the shutter around the instant: `trailing`, `centred` or `leading`.
    #[getter]
    fn alignment(&self) -> &'static str {
        self.scene.truth.alignment.name()
    }

    /// Name of the scene, with its variant and frame.
    #[getter(scene)]
    fn scene_name(&self) -> &str {
        &self.name
    }

    /// Columns and rows.
    #[getter]
    fn size(&self) -> (u32, u32) {
        let Size { width, height } = self.scene.truth.size();
        (width, height)
    }

    fn __repr__(&self) -> String {
        let (size, alignment) = (self.scene.truth.size(), self.alignment());
        let exposure = self.scene.truth.shutter.exposure();
        format!(
            "<Render of {}, {size}, {alignment} shutter of {exposure} frames>",
            self.name
        )
    }
}
