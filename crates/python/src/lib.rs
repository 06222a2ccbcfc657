//! The Python module `shuttertruth._native`: scenes, filters and scores as arrays in memory.
//!
//! `python/shuttertruth` holds what users import; functions here get their arguments checked and
//! converted by it.

mod arrays;
mod blur;
mod command;
mod error;
mod flip;
mod measured;
mod render;
mod score;
mod work;

use pyo3::prelude::*;

#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::blur::{blur, filter_names};
    #[pymodule_export]
    use crate::command::{name_module, run_program};
    #[pymodule_export]
    use crate::error::Error;
    #[pymodule_export]
    use crate::flip::flip;
    #[pymodule_export]
    use crate::measured::measure_filters;
    #[pymodule_export]
    use crate::render::{Render, render, scene_names};
    #[pymodule_export]
    use crate::score::{score, score_pair};
}
