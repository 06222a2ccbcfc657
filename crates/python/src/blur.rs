//! Filters on rendered frames.

use std::collections::BTreeMap;

use filters::{Filter, Input};
use frame::Alignment;
use measure::{Error, FilterChoice, Runner, filter_input, open_gpu};
use numpy::PyReadonlyArray3;
use pyo3::prelude::*;
use terminal::selection::{Programs, select_filters};

use crate::arrays::{Array3, give_image, take_image};
use crate::error::to_exception;
use crate::render::Render;
use crate::work::{MONITOR, work};

/// How a filter runs.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct BlurOptions {
    /// Values in place of the preset's, by parameter.
    set: BTreeMap<String, String>,
    as_written: bool,
    frame_index: u32,
    adapter: Option<String>,
    allow_commands: bool,
}

/// Lists the built-in filters with their presets.
#[pyfunction]
pub fn filter_names() -> PyResult<Vec<String>> {
    let mut names = Vec::new();
    for name in Filter::builtin_names() {
        let filter = Filter::builtin(&name).map_err(to_exception)?;
        names.extend((filter.presets.iter()).map(|preset| format!("{name}:{}", preset.name)));
    }
    Ok(names)
}

/// Blurs a frame, or another picture of it.
#[pyfunction]
pub fn blur<'py>(
    py: Python<'py>,
    render: &Render,
    filter: String,
    color: Option<PyReadonlyArray3<f32>>,
    options: BlurOptions,
) -> PyResult<Array3<'py>> {
    let color = color.map(|color| take_image(&color)).transpose()?;
    let (frame, alignment) = (&render.scene.frame, render.scene.truth.alignment);
    let blurred = work(py, || {
        let choice = choose(filter, &options)?;
        check_alignment(&choice, alignment)?;
        let size = frame.size();
        let choice = (choice.as_written(options.as_written)).scaled_to(size.width);
        let gpu = open_gpu(
            std::slice::from_ref(&choice),
            options.adapter.as_deref(),
            MONITOR,
        )?;
        let mut runner = Runner::new(gpu.as_ref(), &choice, size)?;
        let colors = [color.as_ref().unwrap_or(&frame.color)];
        let input = Input {
            frame_index: options.frame_index,
            ..filter_input(frame, &colors)
        };
        Ok(runner.run(&input)?.remove(0))
    })?;
    Ok(give_image(py, blurred))
}

/// Refuses a filter that blurs for another shutter: its picture would be compared with a wrong
/// truth.
fn check_alignment(choice: &FilterChoice, rendered: Alignment) -> Result<(), Error> {
    let alignment = choice.filter.alignment;
    if alignment == rendered {
        return Ok(());
    }
    Err(Error::Refused(format!(
        "{} blurs for a {alignment} shutter, and the render has a {rendered} one; render with alignment=\"{alignment}\"",
        choice.name()
    )))
}

/// Loads a filter, in its first preset if none is named.
fn choose(filter: String, options: &BlurOptions) -> Result<FilterChoice, Error> {
    let programs = if options.allow_commands {
        Programs::Allowed
    } else {
        Programs::Refused
    };
    let mut choice = select_filters(&[filter], None, &[], programs)?.remove(0);
    for (parameter, value) in &options.set {
        choice.set(parameter, value)?;
    }
    Ok(choice)
}
