//! The program `shuttertruth` inside the module.

use std::ffi::OsString;
use std::path::PathBuf;

use pyo3::prelude::*;

/// Runs a command line, which begins with the program's name; returns its exit code.
#[pyfunction]
pub fn run_program(py: Python, words: Vec<OsString>) -> u8 {
    py.detach(|| cli::run_program(&words))
}

/// Names the file of this module, which finished work is kept for: another module measures again.
#[pyfunction]
pub fn name_module(path: PathBuf) {
    measure::name_program(path);
}
